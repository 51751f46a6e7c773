#include "engine/points/point_index.h"

#include <utility>

#include "base/status_macros.h"

namespace isofield::engine {
namespace {

// A scene is given an index after this many points: sorting them without one takes as long as making one.
constexpr std::uint64_t kHotPoints = 1u << 19;
// Only batches of more points make an index and wait for it, which takes some 30 ms. Smaller ones go on without one,
// because other batches may have joined them and would wait, too.
constexpr std::uint64_t kLargeBatch = 1u << 14;
// If the index has more bricks than this for each point of a batch, going through all bricks takes longer than sorting
// the batch by itself.
constexpr std::uint64_t kBricksPerPoint = 4;

constexpr std::size_t kMostEntries = 64;
constexpr std::size_t kMostInstructions = blobtree::PointGrid::kMostInstructions;  // of all indices that are kept

}  // namespace

PointIndex::PointIndex(gpu::Device& device, const ResidentScene& scene, blobtree::PointGrid grid,
                       blobtree::BrickList bricks)
    : grid_(std::move(grid)), instructions_(bricks.code.size()), windows_(device, scene, std::move(bricks.code)) {
  tapes_.reserve(bricks.bricks.size());
  for (const blobtree::Brick& b : bricks.bricks) {
    Tape tape{b.tape_begin, b.tape_count, 0};
    tape.window = windows_.add(tape.begin, tape.count);
    tapes_.push_back(tape);
  }
}

absl::StatusOr<std::shared_ptr<const PointIndex>> PointIndex::make(gpu::Device& device, const ResidentScene& scene,
                                                                   const std::function<bool()>& cancelled) {
  blobtree::BrickList bricks;
  ISOFIELD_ASSIGN_OR_RETURN(blobtree::PointGrid grid, blobtree::PointGrid::make(scene.tape(), bricks, cancelled));
  const std::shared_ptr<PointIndex> index(new PointIndex(device, scene, std::move(grid), std::move(bricks)));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_RETURN_IF_ERROR(index->windows_.upload(session));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  return index;
}

PointIndexCache::Entry& PointIndexCache::entry(const ResidentScene& scene) {
  Entry* const found = entries_.find(scene, [](const Entry&) { return true; });
  return found ? *found : entries_.add({scene.weak_from_this()});
}

void PointIndexCache::trim() {
  std::size_t instructions = 0, kept = 0;
  entries_.trim([&](const Entry& e) {
    instructions += e.index ? e.index->instructions() : 0;
    return ++kept <= kMostEntries && instructions <= kMostInstructions;
  });
}

absl::StatusOr<std::shared_ptr<const PointIndex>> PointIndexCache::find(gpu::Device& device, const ResidentScene& scene,
                                                                        std::uint64_t points, bool may_make,
                                                                        const std::function<bool()>& cancelled) {
  const auto fits = [&](const PointIndex& index) { return index.tapes().size() <= kBricksPerPoint * points; };
  {
    const base::MutexLock lock(mutex_);
    Entry& e = entry(scene);
    e.points += points;
    if (e.index) return fits(*e.index) ? e.index : nullptr;
    if (!may_make || e.is_tried || e.points < kHotPoints || points <= kLargeBatch) return nullptr;
    e.is_tried = true;  // other batches go on without an index meanwhile
  }
  absl::StatusOr<std::shared_ptr<const PointIndex>> made = PointIndex::make(device, scene, cancelled);
  const base::MutexLock lock(mutex_);
  Entry& e = entry(scene);
  if (absl::IsCancelled(made.status())) {
    e.is_tried = false;
    return made.status();
  }
  if (!made.ok()) return nullptr;
  e.index = *made;
  trim();
  return fits(**made) ? *made : nullptr;
}

}  // namespace isofield::engine
