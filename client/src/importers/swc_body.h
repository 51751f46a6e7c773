#pragma once

#include <array>
#include <vector>

#include "importers/swc_sample.h"
#include "importers/swc_soma.h"
#include "isofield/import.h"

namespace isofield {

// The convex hull of two balls, in coordinates that a linear map about an origin makes.
struct Solid {
  Vector3 origin{};
  // By rows; takes p - origin to the coordinates of the hull.
  std::array<Vector3, 3> to_local = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector3 a{}, b{};
  double radius_a = 0, radius_b = 0;

  Vector3 local(const Vector3& point) const;
  bool contains(const Vector3& point) const;
};

// Where a process joins a soma.
struct Joint {
  // The place in the soma that the process leads to.
  Vector3 target{};
  // The parts of the soma near the process, one or two.
  std::vector<Solid> solids;
  // Processes that are thicker do not begin within the soma.
  double width = 0;

  bool contains(const Vector3& point) const;
  // The place at which the way from `inner` to `outer` leaves the solids; `inner` where that is outside already.
  Vector3 surface(const Vector3& inner, const Vector3& outer) const;
};

// Adds the pieces of a soma that is no stack of frusta: a sphere, an ellipsoid, or a hull for each two neighbours of
// several contours. Named after the soma's first sample or, of several contours, after the first of the upper one.
void add_soma(const Soma& soma, const std::vector<SwcSample>& samples, const ImportOptions& options, v1::Scene& scene);

// The joint of a process that is linked to the soma's sample `at` and whose nearest sample is at `outer`. Its time does
// not grow with the soma. All samples but outlines have a radius.
Joint join_soma(const Somata& somata, int at, const Vector3& outer, const std::vector<SwcSample>& samples);

}  // namespace isofield
