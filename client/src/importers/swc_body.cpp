#include "importers/swc_body.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "importers/import_options.h"
#include "importers/swc_pieces.h"
#include "importers/text.h"

namespace isofield {
namespace {

void set(const glm::dvec3& from, google::protobuf::RepeatedField<double>& to) {
  to.Clear();
  for (int axis = 0; axis < 3; ++axis) to.Add(from[axis]);
}

Solid ball(const glm::dvec3& center, double radius) {
  Solid solid;
  solid.a = solid.b = center;
  solid.radius_a = solid.radius_b = radius;
  return solid;
}

Solid frustum(const SwcSample& a, const SwcSample& b) {
  Solid solid;
  solid.a = a.center;
  solid.b = b.center;
  solid.radius_a = a.radius;
  solid.radius_b = b.radius;
  return solid;
}

double third_axis(const Contour& contour) {
  return (contour.major_length + contour.minor_length) / 2;
}

Solid ellipsoid(const Contour& contour) {
  Solid solid = ball({}, 1);
  solid.origin = contour.center;
  solid.to_local = {1 / contour.major_length * contour.major, 1 / contour.minor_length * contour.minor,
                    1 / third_axis(contour) * contour.normal};
  return solid;
}

// Returns the hull of two balls of a stack: that of the contour `below` and that of the next contour.
Solid hull(const ContourStack& stack, std::size_t below) {
  const auto& a = stack.balls[below];
  const auto& b = stack.balls[below + 1];
  return {stack.origin, stack.to_local, a.center, b.center, a.radius, b.radius};
}

// Adds a transform that places the last node of the scene. `axes` and `origin` are the columns of its matrix.
void add_transform(const std::array<glm::dvec3, 3>& axes, const glm::dvec3& origin, v1::Scene& scene) {
  const std::string child = absl::StrCat("#", scene.nodes_size() - 1);
  v1::Transform& transform = *scene.add_nodes()->mutable_transform();
  transform.set_child(child);
  for (int row = 0; row < 3; ++row) {
    for (const glm::dvec3& axis : axes) transform.add_matrix(axis[row]);
    transform.add_matrix(origin[row]);
  }
}

// Clamps the range of a shape below a transform with these axes. The server limits lengths before and after the
// transform, and rounds them.
double range_within(const std::array<glm::dvec3, 3>& axes, double range) {
  const auto [least, most] = std::minmax({1.0, glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
  return std::clamp(range, 2 * kLeastLength / least, kLargestLength / (2 * most));
}

// Returns the index of the coordinate axis along which a unit vector lies, except for rounding, or 3 where it lies
// along none.
std::size_t axis_of(const glm::dvec3& unit) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(unit[axis]) > 1 - 1e-12) return axis;
  }
  return 3;
}

void add_ellipsoid(const Contour& contour, const ImportOptions& options, v1::Scene& scene) {
  v1::Ellipsoid& shape = *scene.add_nodes()->mutable_ellipsoid();
  const double range = range_of(options, kSwcRangeFactor, contour.minor_length);
  shape.set_range(range);
  glm::dvec3 lengths = {contour.major_length, contour.minor_length, third_axis(contour)};
  const std::size_t major = axis_of(contour.major), minor = axis_of(contour.minor);
  if (major < 3 && minor < 3) {
    glm::dvec3 placed{};
    placed[major] = lengths[0];
    placed[minor] = lengths[1];
    placed[3 - major - minor] = lengths[2];
    set(contour.center, *shape.mutable_center());
    set(placed, *shape.mutable_semi_axes());
    return;
  }
  set(lengths, *shape.mutable_semi_axes());
  const std::array<glm::dvec3, 3> axes = {contour.major, contour.minor, contour.normal};
  shape.set_range(range_within(axes, range));
  add_transform(axes, contour.center, scene);
}

void add_hull(const ContourStack& stack, std::size_t below, const ImportOptions& options, v1::Scene& scene) {
  const Solid solid = hull(stack, below);
  v1::Segment& segment = *scene.add_nodes()->mutable_segment();
  set(solid.a, *segment.mutable_a());
  set(solid.b, *segment.mutable_b());
  segment.set_radius_a(solid.radius_a);
  segment.set_radius_b(solid.radius_b);
  const double radius = std::max(solid.radius_a, solid.radius_b);
  segment.set_range(range_within(stack.axes, range_of(options, kSwcRangeFactor, radius)));
  add_transform(stack.axes, stack.origin, scene);
}

// Returns true where the centres and radii of two balls differ by no more than a hundredth of the radius.
bool is_same(const ContourStack::Ball& a, const ContourStack::Ball& b) {
  return glm::distance(a.center, b.center) + std::abs(a.radius - b.radius) <= 0.01 * a.radius;
}

void add_stack(const Soma& soma, const std::vector<SwcSample>& samples, const ImportOptions& options,
               v1::Scene& scene) {
  const auto& balls = soma.stack.balls;
  std::size_t added = 0;
  for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
    // All contours of an ellipsoid have the same ball, for which one piece is enough.
    if (i > 0 && is_same(balls[added], balls[i]) && is_same(balls[added], balls[i + 1])) continue;
    added = i + 1;
    add_hull(soma.stack, i, options, scene);
    scene.mutable_nodes()->rbegin()->set_name(piece_name(samples[soma.contours[i + 1].first_point]));
  }
}

// Returns the index of the lower one of the two contours between which a point lies, or of the two nearest ones.
std::size_t contour_below(const Soma& soma, const glm::dvec3& point) {
  const glm::dvec3 normal = soma.contours.front().normal;
  const auto above =
      std::upper_bound(soma.contours.begin(), soma.contours.end(), glm::dot(normal, point),
                       [&](double depth, const Contour& contour) { return depth < glm::dot(normal, contour.center); });
  const auto index = std::max<std::ptrdiff_t>(1, above - soma.contours.begin()) - 1;
  return std::min(static_cast<std::size_t>(index), soma.contours.size() - 2);
}

Joint join_contours(const Soma& soma, const glm::dvec3& outer) {
  Joint joint;
  if (soma.contours.size() == 1) {
    joint.target = soma.contours.front().center;
    joint.width = soma.contours.front().minor_length;
    joint.solids = {ellipsoid(soma.contours.front())};
    return joint;
  }
  const std::size_t i = contour_below(soma, outer);
  const Contour& below = soma.contours[i];
  const Contour& above = soma.contours[i + 1];
  const glm::dvec3 step = above.center - below.center;
  const double rise = glm::dot(below.normal, step);
  const double part = glm::dot(below.normal, outer - below.center) / rise;
  joint.target = below.center + std::clamp(part, 0.0, 1.0) * step;
  joint.width = std::max(below.minor_length, above.minor_length);
  joint.solids = {hull(soma.stack, i)};
  return joint;
}

}  // namespace

glm::dvec3 Solid::local(const glm::dvec3& point) const {
  const glm::dvec3 arm = point - origin;
  return {glm::dot(to_local[0], arm), glm::dot(to_local[1], arm), glm::dot(to_local[2], arm)};
}

bool Solid::contains(const glm::dvec3& point) const {
  // Points on the surface count as inside, whatever their rounding.
  constexpr double kTolerance = 1 + 1e-9;
  const glm::dvec3 p = local(point), axis = b - a;
  const double height = glm::length(axis), slope = height > 0 ? (radius_b - radius_a) / height : 0;
  // The hull is a single ball where one of the balls contains the other.
  if (!(height > 0) || std::abs(slope) >= 1) {
    return glm::distance(p, radius_a >= radius_b ? a : b) <= std::max(radius_a, radius_b) * kTolerance;
  }
  // The hull is the union of all balls between the two; t is the place of the one that comes nearest to the point.
  const double along = glm::dot(p - a, axis) / height;
  const double aside = std::sqrt(std::max(0.0, glm::dot(p - a, p - a) - along * along));
  const double t = std::clamp((along + aside * slope / std::sqrt(1 - slope * slope)) / height, 0.0, 1.0);
  return glm::distance(p, a + t * axis) <= (radius_a + t * (radius_b - radius_a)) * kTolerance;
}

bool Joint::contains(const glm::dvec3& point) const {
  return std::any_of(solids.begin(), solids.end(), [&](const Solid& solid) { return solid.contains(point); });
}

glm::dvec3 Joint::surface(const glm::dvec3& inner, const glm::dvec3& outer) const {
  if (!contains(inner)) return inner;
  constexpr int kHalvings = 40;
  const glm::dvec3 step = outer - inner;
  double inside = 0, outside = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (inside + outside) / 2;
    (contains(inner + middle * step) ? inside : outside) = middle;
  }
  return inner + inside * step;
}

void add_soma(const Soma& soma, const std::vector<SwcSample>& samples, const ImportOptions& options, v1::Scene& scene) {
  const SwcSample& first = samples[soma.members.front()];
  if (soma.form == SomaForm::kSphere) {
    add_sphere(first, options, scene);
  } else if (soma.contours.size() == 1) {
    add_ellipsoid(soma.contours.front(), options, scene);
    scene.mutable_nodes()->rbegin()->set_name(piece_name(first));
  } else {
    add_stack(soma, samples, options, scene);
  }
}

Joint join_soma(const Somata& somata, int at, const glm::dvec3& outer, const std::vector<SwcSample>& samples) {
  const Soma& soma = somata.all[somata.soma_of[at]];
  if (soma.form == SomaForm::kContours) return join_contours(soma, outer);
  const SwcSample& sample = samples[soma.form == SomaForm::kSphere ? soma.members.front() : at];
  Joint joint;
  joint.target = sample.center;
  joint.width = sample.radius;
  joint.solids = {ball(sample.center, sample.radius)};
  if (soma.form == SomaForm::kFrusta) {
    const int parent = sample.parent, child = somata.first_child[at];
    if (parent != kNoParent && is_soma(samples[parent])) joint.solids.push_back(frustum(samples[parent], sample));
    if (child != kNoParent) joint.solids.push_back(frustum(sample, samples[child]));
  }
  return joint;
}

}  // namespace isofield
