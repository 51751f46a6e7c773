// The body of a soma that is drawn as contours at several depths.
#pragma once

#include <array>
#include <vector>

#include "importers/swc_contour.h"

namespace isofield {

// The body that contours at several depths outline. It has a ball for each contour, and is the union of the hulls of
// neighbouring balls. A linear map takes p - origin to the coordinates in which these are balls.
struct ContourStack {
  struct Ball {
    glm::dvec3 center{};
    double radius = 0;
  };
  glm::dvec3 origin{};
  // The rows of the map's matrix, and the columns of its inverse.
  std::array<glm::dvec3, 3> to_local{}, axes{};
  std::vector<Ball> balls;
};

// Makes the body of two or more contours, which are ordered by depth along their common normal. The map makes a circle
// of their mean ellipse, and stretches the depth so that the body is as round as possible. The body must not reach
// farther beyond an outer contour than the next contour is away, since another contour would have been drawn there.
// Each ball touches its contour with the slope that the contours have there, so that the contours of an ellipsoid give
// that ellipsoid.
ContourStack stack_contours(const std::vector<Contour>& contours);

}  // namespace isofield
