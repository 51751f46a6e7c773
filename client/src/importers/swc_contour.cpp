#include "importers/swc_contour.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <numeric>

namespace isofield {
namespace {

// How far points of one plane, and points of one depth, may lie apart along the normal, in parts of their mean distance
// from the centre.
constexpr double kPlaneTolerance = 0.1;
constexpr double kDepthTolerance = 1e-3;
// The least roundness, 4 pi area / perimeter^2, of an outline. It is 1 for a circle, 0.24 for an ellipse of axes 10 :
// 1, and 0 for a line there and back.
constexpr double kLeastRoundness = 0.15;
// The same for points that were sorted by angle. Sorting makes a polygon of any points, so that more is demanded.
constexpr double kLeastRoundnessByAngle = 0.4;
// The largest closing edge of an outline, over the length of all other edges. It is 0.5 for an equilateral triangle and
// 0.64 for a half circle, which is an open arc.
constexpr double kLargestGap = 0.55;

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum{};
  for (const glm::dvec3& point : points) sum += point;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

double mean_distance(const std::vector<glm::dvec3>& points, const glm::dvec3& center) {
  double sum = 0;
  for (const glm::dvec3& point : points) sum += glm::distance(point, center);
  return sum / static_cast<double>(points.size());
}

// Returns the normal of the plane through the centre, the point furthest from it and the point that spans the widest
// triangle with both. Returns nothing where all points lie on a line.
std::optional<glm::dvec3> plane_normal(const std::vector<glm::dvec3>& points, const glm::dvec3& center) {
  const auto by_distance = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, center) < glm::distance(b, center);
  };
  const glm::dvec3 arm = *std::max_element(points.begin(), points.end(), by_distance) - center;
  glm::dvec3 normal{};
  for (const glm::dvec3& point : points) {
    const glm::dvec3 candidate = glm::cross(arm, point - center);
    if (glm::length(candidate) > glm::length(normal)) normal = candidate;
  }
  if (!(glm::length(normal) > 1e-3 * glm::dot(arm, arm))) return std::nullopt;
  return 1 / glm::length(normal) * normal;
}

using Point2 = glm::dvec2;

// Area, perimeter, length of the closing edge, and the first and second moments about the origin of a closed polygon.
struct Polygon {
  double area = 0, perimeter = 0, closing = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  explicit Polygon(const std::vector<Point2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point2& p = points[i];
      const Point2& q = points[(i + 1) % points.size()];
      closing = std::hypot(q[0] - p[0], q[1] - p[1]);
      perimeter += closing;
      const double twice = p[0] * q[1] - q[0] * p[1];
      area += twice / 2;
      x += twice * (p[0] + q[0]) / 6;
      y += twice * (p[1] + q[1]) / 6;
      xx += twice * (p[0] * p[0] + p[0] * q[0] + q[0] * q[0]) / 12;
      yy += twice * (p[1] * p[1] + p[1] * q[1] + q[1] * q[1]) / 12;
      xy += twice * (2 * (p[0] * p[1] + q[0] * q[1]) + p[0] * q[1] + q[0] * p[1]) / 24;
    }
  }

  double roundness() const { return 4 * std::numbers::pi * std::abs(area) / (perimeter * perimeter); }
};

// Groups the points into runs of equal depth along the normal, in ascending order. Within a run points keep their
// order.
std::vector<std::vector<int>> runs_of_depth(const std::vector<glm::dvec3>& points, const glm::dvec3& normal) {
  const glm::dvec3 middle = mean(points);
  const double tolerance = kDepthTolerance * mean_distance(points, middle);
  std::vector<double> depths;
  for (const glm::dvec3& point : points) depths.push_back(glm::dot(normal, point - middle));
  std::vector<int> by_depth(points.size());
  std::iota(by_depth.begin(), by_depth.end(), 0);
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](int a, int b) { return depths[a] < depths[b]; });
  std::vector<std::vector<int>> runs;
  for (std::size_t k = 0; k < by_depth.size(); ++k) {
    if (k == 0 || depths[by_depth[k]] - depths[by_depth[k - 1]] > tolerance) runs.emplace_back();
    runs.back().push_back(by_depth[k]);
  }
  for (auto& run : runs) std::sort(run.begin(), run.end());
  return runs;
}

// Fits a contour to each run. Returns none where a run is no outline, or where more than a fifth of the points are in
// runs of one or two.
std::vector<Contour> fit_runs(const std::vector<glm::dvec3>& points, const std::vector<std::vector<int>>& runs,
                              bool in_order) {
  std::vector<Contour> contours;
  std::size_t alone = 0;
  for (const auto& run : runs) {
    if (run.size() < 3) {
      alone += run.size();
      if (5 * alone > points.size()) return {};
      continue;
    }
    std::vector<glm::dvec3> members;
    for (const int i : run) members.push_back(points[i]);
    auto contour = fit_contour(members, in_order);
    if (!contour) return {};
    contour->first_point = run.front();
    contours.push_back(*contour);
  }
  return contours;
}

}  // namespace

std::optional<Contour> fit_contour(const std::vector<glm::dvec3>& points, bool in_order) {
  if (points.size() < 3) return std::nullopt;
  const glm::dvec3 middle = mean(points);
  const double extent = mean_distance(points, middle);
  const auto normal = plane_normal(points, middle);
  if (!normal) return std::nullopt;
  const bool is_flat = std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
    return std::abs(glm::dot(*normal, point - middle)) <= kPlaneTolerance * extent;
  });
  if (!is_flat) return std::nullopt;

  // `flat` has the points in some frame of the plane, in units of the extent.
  const std::size_t axis = std::abs((*normal)[0]) < 0.6 ? 0 : 1;
  glm::dvec3 u{};
  u[axis] = 1;
  u -= glm::dot(u, *normal) * *normal;
  u *= 1 / glm::length(u);
  const glm::dvec3 v = glm::cross(*normal, u);
  std::vector<Point2> flat;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 arm = 1 / extent * (point - middle);
    flat.push_back({glm::dot(arm, u), glm::dot(arm, v)});
  }
  if (!in_order) {
    std::sort(flat.begin(), flat.end(),
              [](const Point2& a, const Point2& b) { return std::atan2(a[1], a[0]) < std::atan2(b[1], b[0]); });
  }
  const Polygon polygon(flat);
  if (!(polygon.roundness() >= (in_order ? kLeastRoundness : kLeastRoundnessByAngle))) return std::nullopt;
  if (in_order && polygon.closing > kLargestGap * (polygon.perimeter - polygon.closing)) return std::nullopt;

  // An ellipse's second moments about its centre are its area times a quarter of the squared semi-axes.
  const double x = polygon.x / polygon.area, y = polygon.y / polygon.area;
  const double xx = polygon.xx / polygon.area - x * x, yy = polygon.yy / polygon.area - y * y;
  const double xy = polygon.xy / polygon.area - x * y;
  const double half_sum = (xx + yy) / 2, half_difference = std::hypot((xx - yy) / 2, xy);
  // Outlines that cross themselves can have moments that no area has.
  if (!(half_sum - half_difference > 1e-4)) return std::nullopt;
  const double a = 2 * std::sqrt(half_sum + half_difference), b = 2 * std::sqrt(half_sum - half_difference);
  // The axes of a circle are arbitrary; it keeps those of the frame.
  const double turn = half_difference > 1e-9 * half_sum ? std::atan2(2 * xy, xx - yy) / 2 : 0;
  const double cosine = std::cos(turn), sine = std::sin(turn);
  double size = 0;
  for (const Point2& p : flat) {
    const double dx = p[0] - x, dy = p[1] - y;
    size += std::hypot((cosine * dx + sine * dy) / a, (cosine * dy - sine * dx) / b);
  }
  size *= extent / static_cast<double>(flat.size());

  Contour contour;
  contour.center = middle + (extent * x * u + extent * y * v);
  contour.major = cosine * u + sine * v;
  contour.minor = cosine * v - sine * u;
  contour.normal = *normal;
  contour.major_length = a * size;
  contour.minor_length = b * size;
  return contour;
}

std::vector<Contour> fit_contours(const std::vector<glm::dvec3>& points, bool in_order) {
  if (points.size() < 6) return {};
  std::vector<glm::dvec3> normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  // Sections in another direction have the plane that the first points of a contour span.
  for (std::size_t i = 2; i < points.size(); ++i) {
    const glm::dvec3 a = points[1] - points[0], b = points[i] - points[0];
    const glm::dvec3 normal = glm::cross(a, b);
    if (!(glm::length(normal) > 1e-2 * glm::length(a) * glm::length(b))) continue;
    normals.push_back(1 / glm::length(normal) * normal);
    break;
  }
  for (const glm::dvec3& normal : normals) {
    auto contours = fit_runs(points, runs_of_depth(points, normal), in_order);
    if (contours.size() < 2) continue;
    for (Contour& contour : contours) face(normal, contour);
    return contours;
  }
  return {};
}

void face(const glm::dvec3& direction, Contour& contour) {
  if (glm::dot(contour.normal, direction) >= 0) return;
  contour.normal = -contour.normal;
  contour.minor = -contour.minor;
}

}  // namespace isofield
