#include "engine/surface/surface_index.h"

#include "base/status_macros.h"
#include "engine/mesh/cell_size.h"
#include "engine/mesh/mesh_lattice.h"

namespace isofield::engine {
namespace {

// The most bricks of all indices that are kept; a brick takes some 20 bytes.
constexpr std::size_t kMostBricks = 1u << 21;
constexpr std::size_t kMostEntries = 64;

absl::StatusOr<std::shared_ptr<const SurfaceIndex>> make_index(const blobtree::Tape& tape,
                                                               const SurfaceRequest& request,
                                                               const std::function<bool()>& cancelled) {
  auto index = std::make_shared<SurfaceIndex>();
  MeshRequest lattice_request{.bounds = request.bounds, .iso = request.iso, .max_cells = request.max_cells};
  if (request.cell_size) {
    lattice_request.cell_size = *request.cell_size;
  } else {
    ISOFIELD_ASSIGN_OR_RETURN(lattice_request.cell_size, automatic_cell_size(tape, lattice_request, cancelled));
  }
  index->cell_size = lattice_request.cell_size;
  if (tape.support.empty()) return index;
  ISOFIELD_ASSIGN_OR_RETURN(
      const SurfaceBricks found,
      surface_bricks(tape, lattice_request, std::nullopt, request.max_cells / blobtree::kCellsPerBrick, cancelled));
  const blobtree::Lattice& lattice = found.lattice;
  const double cell = lattice_request.cell_size;
  const blobtree::dvec3 size{lattice.cells[0] * cell, lattice.cells[1] * cell, lattice.cells[2] * cell};
  index->box = request.bounds.value_or(blobtree::Box{lattice.origin, lattice.origin + size});
  index->tree = blobtree::BrickTree(lattice, found.list.bricks);
  return index;
}

}  // namespace

absl::StatusOr<std::shared_ptr<const SurfaceIndex>> SurfaceIndexCache::get(const SceneLease& scene,
                                                                           const SurfaceRequest& request,
                                                                           const std::function<bool()>& cancelled) {
  if (auto found = find(scene, request)) return found;
  ISOFIELD_ASSIGN_OR_RETURN(auto index, make_index(scene->tape(), request, cancelled));
  keep({scene, request, index});
  return index;
}

std::shared_ptr<const SurfaceIndex> SurfaceIndexCache::find(const SceneLease& scene, const SurfaceRequest& request) {
  const base::MutexLock lock(mutex_);
  const Entry* const found = entries_.find(*scene, [&](const Entry& e) { return e.request == request; });
  return found ? found->index : nullptr;
}

void SurfaceIndexCache::keep(Entry entry) {
  const base::MutexLock lock(mutex_);
  entries_.add(std::move(entry));
  std::size_t bricks = 0, kept = 0;
  entries_.trim(
      [&](const Entry& e) { return ++kept <= kMostEntries && (bricks += e.index->tree.brick_count()) <= kMostBricks; });
}

}  // namespace isofield::engine
