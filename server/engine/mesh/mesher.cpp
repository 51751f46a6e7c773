#include "engine/mesh/mesher.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/status_macros.h"
#include "engine/mesh/cell_size.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_part.h"
#include "engine/mesh/mesh_shells.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;
using blobtree::BrickBox;

PartBricks part_of(const SurfaceBricks& all, const PartSets& sets) {
  PartBricks part{.lattice = all.lattice};
  part.list.code = all.list.code;
  std::array<std::vector<Brick>, 4> nested;
  for (const Brick& b : all.list.bricks) {
    const auto is_in = [&](const blobtree::BrickSet& set) { return set.contains(b.x, b.y, b.z); };
    if (!is_in(sets.sampled)) continue;
    nested[is_in(sets.owned) ? 0 : is_in(sets.placed) ? 1 : is_in(sets.crossed) ? 2 : 3].push_back(b);
  }
  part.owned = static_cast<std::uint32_t>(nested[0].size());
  part.placed = part.owned + static_cast<std::uint32_t>(nested[1].size());
  part.crossed = part.placed + static_cast<std::uint32_t>(nested[2].size());
  for (const auto& bricks : nested) part.list.bricks.insert(part.list.bricks.end(), bricks.begin(), bricks.end());
  return part;
}

PartBricks whole_of(SurfaceBricks all) {
  const auto count = static_cast<std::uint32_t>(all.list.bricks.size());
  return {all.lattice, std::move(all.list), count, count, count};
}

}  // namespace

absl::StatusOr<Mesh> Mesher::mesh(const ResidentScene& scene, const MeshRequest& request,
                                  const MeshCallbacks& callbacks, std::optional<ShellCounts>* shells) {
  Mesh mesh;
  MeshJoiner joiner;
  const auto append = [&](const MeshCells& part) {
    joiner.append(part, mesh);
    return absl::OkStatus();
  };
  ISOFIELD_RETURN_IF_ERROR(cells(scene, request, callbacks, append, shells));
  return mesh;
}

absl::Status Mesher::cells(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                           const Deliver& deliver, std::optional<ShellCounts>* shells) {
  if (shells != nullptr) shells->reset();
  if (request.part) {
    ISOFIELD_ASSIGN_OR_RETURN(const PartMesh mesh, part(scene, request, PartSets(*request.part), callbacks));
    return mesh.cells.cells == 0 ? absl::OkStatus() : deliver(mesh.cells);
  }
  if (const auto kept = cache_.find(scene, request)) {
    for (const auto& part : kept->parts) ISOFIELD_RETURN_IF_ERROR(deliver(*part));
    if (shells != nullptr) *shells = kept->shells ? *kept->shells : count_shells(kept->parts, request.cell_size);
    return absl::OkStatus();
  }
  MeshCache::Kept made;
  ISOFIELD_ASSIGN_OR_RETURN(made.parts, make(scene, request, callbacks, deliver));
  if (shells != nullptr) *shells = made.shells = count_shells(made.parts, request.cell_size);
  cache_.keep(scene, request, std::move(made));
  return absl::OkStatus();
}

std::uint64_t Mesher::max_cells() const {
  constexpr std::uint64_t kMostBricks = 1u << 24;
  return std::min(device_.description().max_buffer_bytes / 4, kMostBricks * blobtree::kCellsPerBrick);
}

absl::StatusOr<double> Mesher::automatic_cell_size(const ResidentScene& scene, const MeshRequest& request,
                                                   const std::function<bool()>& cancelled) const {
  MeshRequest admitted = request;
  admitted.max_cells = std::min(request.max_cells, max_cells());
  return engine::automatic_cell_size(scene.tape(), admitted, cancelled, workers_.for_each());
}

absl::StatusOr<SurfaceBricks> Mesher::find_bricks(const ResidentScene& scene, const MeshRequest& request,
                                                  const std::optional<blobtree::BrickSet>& within,
                                                  const MeshCallbacks& callbacks) const {
  if (scene.tape().support.empty()) return SurfaceBricks{};
  if (callbacks.cancelled && callbacks.cancelled()) return absl::CancelledError("the request was cancelled");
  const std::uint64_t most = std::min(request.max_cells, max_cells()) / blobtree::kCellsPerBrick;
  ISOFIELD_ASSIGN_OR_RETURN(
      SurfaceBricks all, surface_bricks(scene.tape(), request, within, most, callbacks.cancelled, workers_.for_each()));
  std::stable_sort(all.list.bricks.begin(), all.list.bricks.end(),
                   [](const Brick& a, const Brick& b) { return a.z / kLayerBricks < b.z / kLayerBricks; });
  return all;
}

absl::StatusOr<PartMesh> Mesher::part(const ResidentScene& scene, const MeshRequest& request, const PartSets& sets,
                                      const MeshCallbacks& callbacks) {
  ISOFIELD_ASSIGN_OR_RETURN(const SurfaceBricks all, find_bricks(scene, request, sets.sampled, callbacks));
  PartBricks bricks = part_of(all, sets);
  if (bricks.placed == 0) return PartMesh{};
  return mesh_part(device_, kernels_, scene, request, std::move(bricks), callbacks);
}

absl::StatusOr<MeshCache::Parts> Mesher::make(const ResidentScene& scene, const MeshRequest& request,
                                              const MeshCallbacks& callbacks, const Deliver& deliver) {
  MeshCache::Parts made;
  ISOFIELD_ASSIGN_OR_RETURN(SurfaceBricks all, find_bricks(scene, request, std::nullopt, callbacks));
  const std::vector<Brick>& bricks = all.list.bricks;
  const auto run = [&](PartBricks part, double from, double to) -> absl::Status {
    MeshCallbacks own = callbacks;
    if (callbacks.progress) own.progress = [&](double f) { callbacks.progress(from + (to - from) * f); };
    ISOFIELD_ASSIGN_OR_RETURN(PartMesh mesh, mesh_part(device_, kernels_, scene, request, std::move(part), own));
    made.push_back(std::make_shared<const MeshCells>(std::move(mesh.cells)));
    return deliver(*made.back());
  };
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
    ISOFIELD_RETURN_IF_ERROR(run(part_of(all, PartSets(layers)), static_cast<double>(first) / bricks.size(),
                                 static_cast<double>(end) / bricks.size()));
  }
  return made;
}

}  // namespace isofield::engine
