#include "importers/swc_stack.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace isofield {
namespace {

// The largest stretch within the plane or along the depth. The server refuses maps whose condition number is above 1e6.
constexpr double kMostStretch = 500;

// Sets origin and axes of the stack, and `aspect`, the ratio of the axes of the mean ellipse. Larger ellipses weigh
// more.
void set_frame(const std::vector<Contour>& contours, ContourStack& stack, double& aspect) {
  const Contour& widest = *std::max_element(contours.begin(), contours.end(), [](const Contour& a, const Contour& b) {
    return a.major_length * a.minor_length < b.major_length * b.minor_length;
  });
  double xx = 0, xy = 0, yy = 0;
  const auto add_axis = [&](const glm::dvec3& axis, double weight) {
    const double x = glm::dot(axis, widest.major), y = glm::dot(axis, widest.minor);
    xx += weight * x * x;
    xy += weight * x * y;
    yy += weight * y * y;
  };
  for (const Contour& contour : contours) {
    add_axis(contour.major, contour.major_length * contour.major_length);
    add_axis(contour.minor, contour.minor_length * contour.minor_length);
  }
  const double half_sum = (xx + yy) / 2, half_difference = std::hypot((xx - yy) / 2, xy);
  const double turn = half_difference > 1e-9 * half_sum ? std::atan2(2 * xy, xx - yy) / 2 : 0;
  const double ratio = std::sqrt((half_sum + half_difference) / std::max(half_sum - half_difference, 1e-300));
  aspect = std::min(ratio, kMostStretch);
  stack.origin = widest.center;
  stack.axes = {std::cos(turn) * widest.major + std::sin(turn) * widest.minor,
                std::cos(turn) * widest.minor - std::sin(turn) * widest.major, widest.normal};
}

// A contour as a circle of the stretched plane.
struct Ring {
  double depth;
  double squared_radius;
};

// Returns the slope of the squared radius at a ring: that of the parabola through three rings, or of the line through
// two.
double slope_at(const std::vector<Ring>& rings, std::size_t i) {
  const auto secant = [&](std::size_t a, std::size_t b) {
    return (rings[b].squared_radius - rings[a].squared_radius) / (rings[b].depth - rings[a].depth);
  };
  if (rings.size() == 2) return secant(0, 1);
  const std::size_t m = std::clamp<std::size_t>(i, 1, rings.size() - 2);
  const double below = secant(m - 1, m), above = secant(m, m + 1);
  const double curvature = (above - below) / (rings[m + 1].depth - rings[m - 1].depth);
  return below + curvature * (2 * rings[i].depth - rings[m - 1].depth - rings[m].depth);
}

// Returns the stretch of the depth that makes a ball of the body, if the rings are those of an ellipsoid. Their squared
// radii are then a parabola of the depth, whose leading coefficient is minus the square of the stretch.
double roundest_stretch(const std::vector<Ring>& rings) {
  const Ring& first = rings.front();
  const Ring& last = rings.back();
  const double height = last.depth - first.depth;
  if (rings.size() == 2) return std::sqrt(std::abs(last.squared_radius - first.squared_radius)) / height;
  // This is a least-squares fit of the rise above the line from the first ring to the last, by -(d - d0) (d - d1).
  double product = 0, square = 0;
  for (const Ring& ring : rings) {
    const double t = (ring.depth - first.depth) / height;
    const double line = first.squared_radius + t * (last.squared_radius - first.squared_radius);
    const double arch = t * (1 - t) * height * height;
    product += arch * (ring.squared_radius - line);
    square += arch * arch;
  }
  return std::sqrt(std::max(0.0, product / square));
}

// A ball that touches a ring. `depth` is that of its centre, after the stretch.
struct Touching {
  double depth;
  double radius;
};

std::vector<Touching> touching_balls(const std::vector<Ring>& rings, double stretch) {
  std::vector<Touching> balls;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double depth = stretch * rings[i].depth;
    // A ball about c touches the ring where the squared radius falls off by 2 (depth - c).
    const double middle = std::clamp(depth + slope_at(rings, i) / (2 * stretch), stretch * rings.front().depth,
                                     stretch * rings.back().depth);
    balls.push_back({middle, std::sqrt(rings[i].squared_radius + (depth - middle) * (depth - middle))});
  }
  return balls;
}

// Returns true where the balls reach no farther beyond the outer rings than the next ring is away.
bool ends_in_time(const std::vector<Ring>& rings, const std::vector<Touching>& balls, double stretch) {
  const std::size_t last = rings.size() - 1;
  const double low = 2 * rings[0].depth - rings[1].depth, high = 2 * rings[last].depth - rings[last - 1].depth;
  return std::all_of(balls.begin(), balls.end(), [&](const Touching& ball) {
    return ball.depth - ball.radius >= stretch * low && ball.depth + ball.radius <= stretch * high;
  });
}

}  // namespace

ContourStack stack_contours(const std::vector<Contour>& contours) {
  ContourStack stack;
  double aspect = 1;
  set_frame(contours, stack, aspect);
  std::vector<Ring> rings;
  for (const Contour& contour : contours) {
    rings.push_back(
        {glm::dot(stack.axes[2], contour.center - stack.origin), contour.major_length * contour.minor_length * aspect});
  }
  if (rings.front().depth > rings.back().depth) {
    stack.axes[2] = -stack.axes[2];
    stack.axes[1] = -stack.axes[1];
    for (Ring& ring : rings) ring.depth = -ring.depth;
  }
  double stretch = std::clamp(roundest_stretch(rings), 1 / kMostStretch, kMostStretch);
  std::vector<Touching> touching = touching_balls(rings, stretch);
  while (!ends_in_time(rings, touching, stretch) && stretch < kMostStretch) {
    stretch = std::min(1.2 * stretch, kMostStretch);
    touching = touching_balls(rings, stretch);
  }
  stack.to_local = {stack.axes[0], aspect * stack.axes[1], stretch * stack.axes[2]};
  stack.axes = {stack.axes[0], 1 / aspect * stack.axes[1], 1 / stretch * stack.axes[2]};
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const glm::dvec3 arm = contours[i].center - stack.origin;
    stack.balls.push_back(
        {{glm::dot(stack.to_local[0], arm), glm::dot(stack.to_local[1], arm), touching[i].depth}, touching[i].radius});
  }
  return stack;
}

}  // namespace isofield
