#include "engine/mesh/brick_tapes.h"

#include <utility>

#include "base/status_macros.h"
#include "engine/dealing.h"
#include "engine/kernels/bindings.h"

namespace isofield::engine {

BrickTapes::BrickTapes(gpu::Device& device, const Kernels& kernels, const ResidentScene& scene,
                       blobtree::BrickList& list)
    : dispatch_runs_(device.profile().dispatch_runs),
      kernels_(kernels),
      scene_(scene),
      bricks_(list.bricks),
      windows_(device, scene, std::move(list.code)) {
  window_of_.reserve(list.bricks.size());
  for (blobtree::Brick& b : list.bricks) window_of_.push_back(windows_.add(b.tape_begin, b.tape_count));
}

absl::Status BrickTapes::run(Session& session, const shaders::Spirv& shader, MeshConstants constants, const Jobs& jobs,
                             std::uint32_t per_workgroup, gpu::Commands::Bindings own) {
  if (jobs.empty()) return absl::OkStatus();
  std::vector<Job> all;
  for (const auto& [of, members] : jobs) {
    const std::size_t begin = all.size();
    all.insert(all.end(), members.begin(), members.end());
    deal(all, begin, all.size(), dispatch_runs_);
  }
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const list, session.lend(std::span(all)));
  own.push_back({binding::mesh::kJobs, list});
  constants.first = 0;
  for (const auto& [of, members] : jobs) {
    const KernelKind kind = of.is_single ? KernelKind::single_leaf(scene_.tape()) : KernelKind::of(scene_.tape());
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(shader, windows_.kind(kind, of.window)));
    constants.count = static_cast<std::uint32_t>(members.size());
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel, windows_.bindings(of.window, own), constants,
                                                         (constants.count + per_workgroup - 1) / per_workgroup));
    constants.first += constants.count;
  }
  return absl::OkStatus();
}

}  // namespace isofield::engine
