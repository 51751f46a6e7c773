// The last passes of the mesher, which cut quads into triangles. There is a quad around every edge that the surface
// crosses. It becomes two triangles or, where these could intersect others, a fan of four triangles around the
// crossing, which becomes a vertex.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesh_layout.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"

namespace isofield::engine {

// Serves one part of a mesh on one thread: call cut(), then make().
class QuadCutter {
 public:
  using Check = std::function<absl::Status(double)>;  // receives the progress; a failure ends the pass

  // `quads` are the bindings of shaders/lib/mesh_quads.glsl. `starts` are those of the bricks whose quads are cut, and
  // the totals. All that is given by reference must outlive this.
  QuadCutter(gpu::Device& device, const Kernels& kernels, const MeshConstants& constants, gpu::Commands::Bindings quads,
             std::span<const MeshStart> starts, const Check& check)
      : device_(device),
        kernels_(kernels),
        constants_(constants),
        quads_(std::move(quads)),
        starts_(starts),
        check_(check) {}

  // Decides how each quad is cut. `kinds` has the BrickKind bits of each brick; `is_smooth` says that no brick may have
  // creases.
  absl::Status cut(const gpu::Buffer& positions, const gpu::Buffer& kinds, bool is_smooth);

  // The first fan of each brick, and the total.
  const std::vector<MeshStart>& fan_starts() const { return fan_starts_; }
  std::uint32_t fans() const { return fan_starts_.back()[0]; }
  bool has_fans(std::uint32_t brick) const { return fan_starts_[brick + 1][0] > fan_starts_[brick][0]; }

  // Fills in the corners of the triangles, as MeshCells has them, and the positions of the fans' centres, which it also
  // returns as a buffer. The crossings of bricks with fans must be known.
  absl::StatusOr<gpu::Buffer> make(std::vector<std::uint32_t>& corners, std::vector<float>& centres);

 private:
  std::uint32_t quad_count() const { return starts_.back()[1]; }
  std::uint32_t fans_before(std::uint32_t quad) const { return quad < quad_count() ? cuts_[quad] >> 2 : fans(); }
  void number_fans();
  gpu::Commands::Bindings with_quads(const gpu::Commands::Bindings& own) const;

  gpu::Device& device_;
  const Kernels& kernels_;
  const MeshConstants& constants_;
  const gpu::Commands::Bindings quads_;
  const std::span<const MeshStart> starts_;
  const Check& check_;
  std::vector<std::uint32_t> cuts_;  // for each quad: its QuadCut | the number of fans before it << 2
  std::vector<MeshStart> fan_starts_;
  gpu::Buffer cuts_buffer_, corners_, fan_starts_buffer_;
};

}  // namespace isofield::engine
