// Fits ellipses to the outlines that somata are drawn with in SWC files.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace isofield {

// An ellipse that is fitted to a closed outline in a plane.
struct Contour {
  glm::dvec3 center{};
  // Unit vectors along the longer axis, the shorter one and the plane's normal: a right-handed frame.
  glm::dvec3 major{}, minor{}, normal{};
  // Semi-axes, major_length >= minor_length.
  double major_length = 0, minor_length = 0;
  // The least index of its points in the list that it is fitted to.
  int first_point = 0;
};

// Fits an ellipse to points that run once round an outline (`in_order`), or that surround a place in any order, as the
// ends of a star do. Its centre and the ratio of its axes are those of the enclosed area, so that densely spaced points
// count no more than others. Its size is such that the points lie on it on average. Returns nothing where there are
// fewer than three points, where they are not in one plane (within a tenth of their mean distance from the centre), or
// where they form no closed outline but, for example, a line or an open arc.
std::optional<Contour> fit_contour(const std::vector<glm::dvec3>& points, bool in_order);

// Fits ellipses to outlines in two or more parallel planes, ordered by depth along their common normal. Returns none
// where more than a fifth of the points lie outside of such planes, or where the points of a plane form no outline.
std::vector<Contour> fit_contours(const std::vector<glm::dvec3>& points, bool in_order);

// Turns the frame over where its normal points away from `direction`.
void face(const glm::dvec3& direction, Contour& contour);

}  // namespace isofield
