// BrickTapes runs the mesher's kernels that evaluate the field: it holds the tapes of a mesh's bricks, and gives every
// brick the kernel and the window that its tape needs.
#pragma once

#include <absl/status/status.h>

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesh_layout.h"
#include "engine/residency/resident_scene.h"
#include "engine/residency/tape_windows.h"
#include "engine/session.h"

namespace isofield::engine {

// Belongs to one thread. Owns the tapes' buffers.
class BrickTapes {
 public:
  // Takes the code out of `list`, and changes the beginnings of the bricks' tapes to places in their windows. All
  // arguments must outlive it.
  BrickTapes(gpu::Device& device, const Kernels& kernels, const ResidentScene& scene, blobtree::BrickList& list);
  absl::Status upload(Session& session) { return windows_.upload(session); }

  // Jobs with the same Kernel go into one dispatch: they share the window of their bricks' tapes, and the kernel. Tapes
  // that are a single leaf have a kernel without operators; all others have the scene's.
  struct Kernel {
    std::uint32_t window;
    bool is_single;
    auto operator<=>(const Kernel&) const = default;
  };
  using Job = std::array<std::uint32_t, 2>;  // a brick's number; a number that the shader understands, such as an octet
  using Jobs = std::map<Kernel, std::vector<Job>>;
  Kernel kernel_of(std::uint32_t brick) const { return {window_of_[brick], bricks_[brick].tape_count == 1}; }

  // Records the dispatches of all jobs, `per_workgroup` jobs in each workgroup. It adds the list of jobs to the
  // shader's `own` bindings, and sets first and count of the constants to the jobs of each kernel.
  absl::Status run(Session& session, const shaders::Spirv& shader, MeshConstants constants, const Jobs& jobs,
                   std::uint32_t per_workgroup, gpu::Commands::Bindings own);

  // Records a job for each wanted brick from `first` to before first + count, each in a workgroup of its own. The
  // second number of a job is the brick's number counted from `first`.
  template <class Wanted>
  absl::Status run_each(Session& session, const shaders::Spirv& shader, const MeshConstants& constants,
                        std::uint32_t first, std::uint32_t count, const Wanted& is_wanted,
                        gpu::Commands::Bindings own) {
    Jobs jobs;
    for (std::uint32_t b = first; b < first + count; ++b) {
      if (is_wanted(b)) jobs[kernel_of(b)].push_back({b, b - first});
    }
    return run(session, shader, constants, jobs, 1, std::move(own));
  }

 private:
  std::uint64_t dispatch_runs_;
  const Kernels& kernels_;
  const ResidentScene& scene_;
  const std::vector<blobtree::Brick>& bricks_;
  TapeWindows windows_;
  std::vector<std::uint32_t> window_of_;  // the window of each brick's tape
};

}  // namespace isofield::engine
