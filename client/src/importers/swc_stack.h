#pragma once

#include <array>
#include <vector>

#include "importers/swc_contour.h"

namespace isofield {

// The body that contours at several depths outline: balls, one for each contour, and the hull of each two neighbours,
// in coordinates that a linear map makes of the arm from `origin`.
struct ContourStack {
  struct Ball {
    Vector3 center{};
    double radius = 0;
  };
  Vector3 origin{};
  // The map by rows, and its inverse by columns.
  std::array<Vector3, 3> to_local{}, axes{};
  std::vector<Ball> balls;
};

// `contours`: two or more, by depth along their common normal. The map makes circles of their mean ellipse, and
// stretches the depth so that the body is as round as it can be; it ends within one distance of contours beyond the
// outer ones, since another contour would have been drawn there. Each ball touches its contour with the slope that the
// contours have there, so that those of an ellipsoid give the ellipsoid.
ContourStack stack_contours(const std::vector<Contour>& contours);

}  // namespace isofield
