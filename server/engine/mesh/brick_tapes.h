// Kernels that follow the tapes of a mesh's bricks.
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

class BrickTapes {
 public:
  // Takes the list's code, and lets its bricks' tapes begin in their windows. What is given must outlive it.
  BrickTapes(gpu::Device& device, const Kernels& kernels, const ResidentScene& scene, blobtree::BrickList& list);
  absl::Status upload(Session& session) { return windows_.upload(session); }

  // What jobs must have in common to be done by one dispatch: the window that their bricks' tapes are in, and the
  // kernel. Tapes that are a single leaf have the kernel that knows no operator, others the scene's.
  struct Kernel {
    std::uint32_t window;
    bool is_single;
    auto operator<=>(const Kernel&) const = default;
  };
  using Job = std::array<std::uint32_t, 2>;  // a brick, and what of it
  using Jobs = std::map<Kernel, std::vector<Job>>;
  Kernel kernel_of(std::uint32_t brick) const { return {window_of_[brick], bricks_[brick].tape_count == 1}; }

  // Records the jobs, `per_workgroup` in each workgroup, with a list of them beside the shader's own bindings. The
  // constants' first and count become those of each kernel's jobs.
  absl::Status run(Session& session, const shaders::Spirv& shader, MeshConstants constants, const Jobs& jobs,
                   std::uint32_t per_workgroup, gpu::Commands::Bindings own);

  // Records a job for each wanted brick from `first` to before first + count, in a workgroup of its own. The second
  // number of the job is the brick's number from `first` on.
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
  std::vector<std::uint32_t> window_of_;  // of the bricks' tapes
};

}  // namespace isofield::engine
