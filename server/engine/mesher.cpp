#include "engine/mesher.h"

#include <algorithm>
#include <utility>

#include "engine/mesh_lattice.h"
#include "engine/mesh_part.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;
using blobtree::BrickBox;

// How far a brick lies outside the box, in bricks.
std::uint32_t distance(const BrickBox& box, const Brick& b) {
  const auto along = [](std::uint32_t low, std::uint32_t high, std::uint32_t i) {
    return i < low ? low - i : i >= high ? i - high + 1 : 0;
  };
  return std::max(
      {along(box.low[0], box.high[0], b.x), along(box.low[1], box.high[1], b.y), along(box.low[2], box.high[2], b.z)});
}

// The bricks of `box` with those around it.
PartBricks part_of(const SurfaceBricks& all, const BrickBox& box) {
  PartBricks part{.lattice = all.lattice};
  part.list.code = all.list.code;
  std::vector<Brick> by_distance[kHaloBricks + 1];
  for (const Brick& b : all.list.bricks) {
    const std::uint32_t d = distance(box, b);
    if (d <= kHaloBricks) by_distance[d].push_back(b);
  }
  part.owned = static_cast<std::uint32_t>(by_distance[0].size());
  part.inner = part.owned + static_cast<std::uint32_t>(by_distance[1].size());
  for (const auto& bricks : by_distance) {
    part.list.bricks.insert(part.list.bricks.end(), bricks.begin(), bricks.end());
  }
  return part;
}

PartBricks whole_of(SurfaceBricks all) {
  const auto count = static_cast<std::uint32_t>(all.list.bricks.size());
  return {all.lattice, std::move(all.list), count, count};
}

}  // namespace

absl::StatusOr<Mesh> Mesher::mesh(const ResidentScene& scene, const MeshRequest& request,
                                  const MeshCallbacks& callbacks) {
  Mesh mesh;
  MeshJoiner joiner;
  ISOFIELD_RETURN_IF_ERROR(cells(scene, request, callbacks, [&](const MeshCells& part) {
    joiner.append(part, mesh);
    return absl::OkStatus();
  }));
  return mesh;
}

absl::Status Mesher::cells(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                           const Deliver& deliver) {
  if (request.part) return make(scene, request, callbacks, deliver).status();
  if (const auto kept = cache_.find(scene, request)) {
    for (const auto& part : *kept) ISOFIELD_RETURN_IF_ERROR(deliver(*part));
    return absl::OkStatus();
  }
  ISOFIELD_ASSIGN_OR_RETURN(MeshCache::Parts made, make(scene, request, callbacks, deliver));
  cache_.keep(scene, request, std::move(made));
  return absl::OkStatus();
}

absl::StatusOr<MeshCache::Parts> Mesher::make(const ResidentScene& scene, const MeshRequest& request,
                                              const MeshCallbacks& callbacks, const Deliver& deliver) {
  if (scene.tape().support.empty()) return MeshCache::Parts{};
  if (callbacks.cancelled && callbacks.cancelled()) return absl::CancelledError("the request was cancelled");
  // One binding holds a word for every cell.
  const std::uint64_t bound = device_.description().max_buffer_bytes / (4 * blobtree::kCellsPerBrick);
  const std::uint64_t most = std::min<std::uint64_t>({request.max_cells / blobtree::kCellsPerBrick, bound, 1u << 24});
  ISOFIELD_ASSIGN_OR_RETURN(SurfaceBricks all, surface_bricks(scene.tape(), request, most, callbacks.cancelled));
  std::vector<Brick>& bricks = all.list.bricks;
  if (bricks.empty()) return MeshCache::Parts{};
  std::stable_sort(bricks.begin(), bricks.end(),
                   [](const Brick& a, const Brick& b) { return a.z / kLayerBricks < b.z / kLayerBricks; });
  MeshCache::Parts made;
  const auto run = [&](PartBricks part, double from, double to) -> absl::Status {
    MeshCallbacks own = callbacks;
    if (callbacks.progress) own.progress = [&](double f) { callbacks.progress(from + (to - from) * f); };
    if (part.owned == 0) return absl::OkStatus();
    ISOFIELD_ASSIGN_OR_RETURN(MeshCells cells, mesh_part(device_, kernels_, scene, request, std::move(part), own));
    made.push_back(std::make_shared<const MeshCells>(std::move(cells)));
    return deliver(*made.back());
  };
  if (request.part) {
    ISOFIELD_RETURN_IF_ERROR(run(part_of(all, *request.part), 0, 1));
    return made;
  }
  for (std::size_t first = 0, end = 0; first < bricks.size(); first = end) {
    while (end < bricks.size() &&
           (end - first < request.bricks_at_once || bricks[end].z / kLayerBricks == bricks[end - 1].z / kLayerBricks)) {
      ++end;
    }
    if (first == 0 && end == bricks.size()) {
      ISOFIELD_RETURN_IF_ERROR(run(whole_of(std::move(all)), 0, 1));
      return made;
    }
    BrickBox layers{{0, 0, bricks[first].z / kLayerBricks * kLayerBricks}, {~0u, ~0u, ~0u}};
    if (end < bricks.size()) layers.high[2] = bricks[end].z / kLayerBricks * kLayerBricks;
    ISOFIELD_RETURN_IF_ERROR(run(part_of(all, layers), static_cast<double>(first) / bricks.size(),
                                 static_cast<double>(end) / bricks.size()));
  }
  return made;
}

}  // namespace isofield::engine
