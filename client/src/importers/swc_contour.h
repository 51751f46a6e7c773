#pragma once

#include <optional>
#include <vector>

#include "importers/vector3.h"

namespace isofield {

// The ellipse that stands for a closed outline in a plane.
struct Contour {
  Vector3 center{};
  // Unit vectors along the longer axis, the shorter one and the plane's normal: a right-handed frame.
  Vector3 major{}, minor{}, normal{};
  // Semi-axes, major_length >= minor_length.
  double major_length = 0, minor_length = 0;
  // The least index of its points in the list that it was fitted to.
  int first_point = 0;
};

// The ellipse of points that run once round an outline, `in_order`, or that surround a place in any order, as the ends
// of a star do. Its centre and the ratio of its axes are those of the area inside, so that unevenly spread points count
// no more than others, and its size is such that the points lie on it in the mean. Nothing: fewer than three points,
// not in one plane (to a tenth of the mean distance from the centre), or no closed outline, such as a line or an open
// arc.
std::optional<Contour> fit_contour(const std::vector<Vector3>& points, bool in_order);

// The ellipses of outlines in parallel planes, two or more, by their depth along a common normal. Nothing: the points
// do not lie in such planes, but for a fifth that may lie between, or those of a plane are no outline.
std::vector<Contour> fit_contours(const std::vector<Vector3>& points, bool in_order);

// Turns the frame over where its normal points away from `direction`.
void face(const Vector3& direction, Contour& contour);

}  // namespace isofield
