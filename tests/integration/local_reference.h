// The reference evaluator for scenes of thousands of pieces. At each point it evaluates only the pieces near it. The
// value is the same, because every operator has g(f, 0) = f and a piece is 0 beyond its range.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "isofield/v1/scene.pb.h"
#include "reference/evaluator.h"

namespace isofield::integration_test {

// Evaluates scenes as the importers make them: spheres and segments, joined by one operator, which is the last node.
// The scene must outlive it. Only one thread may use it.
class LocalReference {
 public:
  // `cell` is the edge length, in model units, of the cells whose points share a part of the scene. It should be about
  // a piece's size.
  LocalReference(const v1::Scene& scene, double cell);

  reference::Sample evaluate(const blobtree::dvec3& p);

 private:
  using Cell = std::array<std::int64_t, 3>;
  std::unique_ptr<reference::Evaluator> part(const Cell& cell) const;

  const v1::Scene& scene_;
  const double cell_;
  std::vector<std::array<double, 6>> supports_;                  // low and high corners
  std::map<Cell, std::unique_ptr<reference::Evaluator>> parts_;  // null if nothing is near
};

}  // namespace isofield::integration_test
