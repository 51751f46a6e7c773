// The pieces of somata, and the places where processes (axons and dendrites) join them.
#pragma once

#include <array>
#include <vector>

#include "importers/swc_sample.h"
#include "importers/swc_soma.h"
#include "isofield/import.h"

namespace isofield {

// The convex hull of two balls after a linear map about an origin. The balls `a` and `b` are in mapped coordinates.
struct Solid {
  glm::dvec3 origin{};
  // The rows of the map's matrix, which takes p - origin to the mapped coordinates.
  std::array<glm::dvec3, 3> to_local = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  glm::dvec3 a{}, b{};
  double radius_a = 0, radius_b = 0;

  glm::dvec3 local(const glm::dvec3& point) const;
  bool contains(const glm::dvec3& point) const;
};

// The place where a process joins a soma.
struct Joint {
  // The point in the soma that the process leads to.
  glm::dvec3 target{};
  // The parts of the soma near the process, one or two.
  std::vector<Solid> solids;
  // The least radius of a process that is thicker than the soma there. Samples of such a process are kept even inside
  // the soma.
  double width = 0;

  bool contains(const glm::dvec3& point) const;
  // Returns the point at which the line from `inner` to `outer` leaves the solids, or `inner` itself where it is
  // outside already.
  glm::dvec3 surface(const glm::dvec3& inner, const glm::dvec3& outer) const;
};

// Adds the pieces of a soma that is no stack of frusta: a sphere, an ellipsoid, or one hull for each pair of
// neighbouring contours. A sphere or an ellipsoid is named after the soma's first sample, a hull after the first sample
// of its upper contour.
void add_soma(const Soma& soma, const std::vector<SwcSample>& samples, const ImportOptions& options, v1::Scene& scene);

// Returns the joint of a process that is linked to the sample `at` of the soma and whose nearest sample is at `outer`.
// All samples but those of outlines must have a radius. The cost does not depend on the size of the soma, except for a
// binary search.
Joint join_soma(const Somata& somata, int at, const glm::dvec3& outer, const std::vector<SwcSample>& samples);

}  // namespace isofield
