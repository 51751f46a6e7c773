#include "blobtree/node_reader.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/string_view.h>

#include <cmath>
#include <numbers>

namespace isofield::blobtree {
namespace {

using Numbers = google::protobuf::RepeatedField<double>;

constexpr double kRadians = std::numbers::pi / 180;

// Reads the fields of one node and keeps the first refusal.
class FieldReader {
 public:
  explicit FieldReader(const Node& node) : node_(node) {}

  absl::Status status() const { return status_; }

  void refuse(absl::string_view field, absl::string_view value, absl::string_view expected) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(node_.path, ".", field, " = ", value, ": expected ", expected));
  }

  double number(absl::string_view field, double value, double least, double most, absl::string_view expected) {
    if (!(value >= least && value <= most)) refuse(field, absl::StrCat(value), expected);
    return value;
  }
  double positive(absl::string_view field, double value) {
    return number(field, value, kMinLength, kMaxCoordinate,
                  absl::StrCat("a length > 0, within [", kMinLength, ", ", kMaxCoordinate, "]"));
  }
  double coordinate(absl::string_view field, double value) {
    return number(field, value, -kMaxCoordinate, kMaxCoordinate,
                  absl::StrCat("a finite number of magnitude at most ", kMaxCoordinate));
  }
  dvec3 point(absl::string_view field, const Numbers& numbers, const dvec3& otherwise = {}) {
    return has_size(field, numbers, 3, true) ? stated_point(field, numbers) : otherwise;
  }
  // A point without a default.
  dvec3 stated_point(absl::string_view field, const Numbers& numbers) {
    if (!has_size(field, numbers, 3, false)) return {};
    return {coordinate(absl::StrCat(field, ".x"), numbers[0]), coordinate(absl::StrCat(field, ".y"), numbers[1]),
            coordinate(absl::StrCat(field, ".z"), numbers[2])};
  }
  // A direction of any length but 0.
  dvec3 direction(absl::string_view field, const Numbers& numbers, const dvec3& otherwise) {
    const dvec3 v = point(field, numbers, otherwise);
    if (!(length(v) > 0)) refuse(field, "(0, 0, 0)", "a direction of a length that is not 0");
    return v;
  }
  dvec3 lengths(absl::string_view field, const Numbers& numbers) {
    if (!has_size(field, numbers, 3, false)) return {1, 1, 1};
    return {positive(absl::StrCat(field, ".x"), numbers[0]), positive(absl::StrCat(field, ".y"), numbers[1]),
            positive(absl::StrCat(field, ".z"), numbers[2])};
  }
  // False when the default is meant, or the count is refused.
  bool has_size(absl::string_view field, const Numbers& numbers, int size, bool may_be_empty) {
    if (numbers.empty() && may_be_empty) return false;
    if (numbers.size() == size) return true;
    refuse(field, absl::StrCat("[", numbers.size(), " numbers]"), absl::StrCat(size, " numbers"));
    return false;
  }

 private:
  const Node& node_;
  absl::Status status_;
};

void read_segment(const v1::Segment& m, Node& node, FieldReader& in) {
  const dvec3 a = in.stated_point("a", m.a()), b = in.stated_point("b", m.b());
  const dvec3 axis = b - a;
  node.shape = Shape::kSegment;
  node.size = {length(axis), in.positive("radius_a", m.radius_a()), in.positive("radius_b", m.radius_b())};
  node.range = in.positive("range", m.range());
  node.frame = node.size[0] > 0 ? Affine::frame(a, axis) : Affine::translation(a);
}

void read_box(const v1::Box& m, Node& node, FieldReader& in) {
  const dvec3 half = in.lengths("half_size", m.half_size());
  const double least = std::min({half.x, half.y, half.z});
  node.shape = Shape::kBox;
  node.frame = Affine::translation(in.point("center", m.center()));
  node.size = {half.x, half.y, half.z,
               in.number("rounding", m.rounding(), 0, least,
                         absl::StrCat("a radius within [0, ", least, "], the smallest half size"))};
  node.range = in.positive("range", m.range());
}

void read_cylinder(const v1::Cylinder& m, Node& node, FieldReader& in) {
  const dvec3 a = in.stated_point("a", m.a()), b = in.stated_point("b", m.b());
  const dvec3 axis = b - a;
  node.shape = Shape::kCylinder;
  node.size = {length(axis) / 2, in.positive("radius", m.radius())};
  node.range = in.positive("range", m.range());
  if (node.size[0] >= kMinLength) {
    node.frame = Affine::frame((a + b) * 0.5, axis);
  } else {
    in.refuse("b", "a", "a point that differs from a");
  }
}

void read_opening(const v1::Opening& m, Node& node, FieldReader& in) {
  operators::Opening o = operators::camel();
  if (m.preset() == v1::Opening::ORGANIC) o = operators::organic();
  if (m.preset() == v1::Opening::CONTACT) o = operators::contact();
  if (m.preset() < 0 || m.preset() > v1::Opening::CONTACT) {
    in.refuse("opening.preset", absl::StrCat(static_cast<int>(m.preset())), "CAMEL, ORGANIC or CONTACT");
  }
  const bool stated[] = {m.has_alpha0(), m.has_alpha1(), m.has_alpha2(), m.has_theta0(),
                         m.has_theta1(), m.has_theta2(), m.has_w0(),     m.has_w1()};
  const double values[] = {m.alpha0(), m.alpha1(), m.alpha2(), m.theta0(), m.theta1(), m.theta2(), m.w0(), m.w1()};
  constexpr const char* kNames[] = {"opening.alpha0", "opening.alpha1", "opening.alpha2", "opening.theta0",
                                    "opening.theta1", "opening.theta2", "opening.w0",     "opening.w1"};
  double* const parameters[] = {&o.alpha0, &o.alpha1, &o.alpha2, &o.theta0, &o.theta1, &o.theta2, &o.w0, &o.w1};
  bool any = false, all = true;
  for (bool s : stated) any |= s, all &= s;
  if (m.preset() == v1::Opening::PRESET_UNSPECIFIED && any && !all) {
    for (int i = 0; i < 8; ++i) {
      if (!stated[i]) in.refuse(kNames[i], "(absent)", "a value, or a preset that supplies it");
    }
  }
  for (int i = 0; i < 8; ++i) {
    if (!stated[i]) continue;
    if (i < 3) {
      *parameters[i] = in.number(kNames[i], values[i], 0, 180, "degrees within [0, 180]") * kRadians;
    } else if (i < 6) {
      *parameters[i] = in.number(kNames[i], values[i], 0, 45, "degrees within [0, 45]") * kRadians;
    } else {
      *parameters[i] = in.number(kNames[i], values[i], 0.05, 20, "a slope within [0.05, 20]");
    }
  }
  const auto degrees = [](double radians) { return absl::StrCat(radians / kRadians); };
  if (!(o.alpha0 < o.alpha1)) in.refuse("opening.alpha1", degrees(o.alpha1), "more than alpha0 = " + degrees(o.alpha0));
  if (!(o.alpha1 < o.alpha2)) in.refuse("opening.alpha2", degrees(o.alpha2), "more than alpha1 = " + degrees(o.alpha1));
  node.opening = o;
}

void read_silhouette(const v1::Silhouette& m, Node& node, FieldReader& in) {
  switch (m.kind()) {
    case v1::Silhouette::KIND_UNSPECIFIED:
    case v1::Silhouette::SMOOTH:
      if (m.k() != 0) in.refuse("silhouette.k", absl::StrCat(m.k()), "no k, or kind BULGE");
      node.silhouette = {};
      return;
    case v1::Silhouette::BULGE:
      node.silhouette = {operators::Silhouette::Kind::kBulge,
                         in.number("silhouette.k", m.k(), 0, 1, "a strength within [0, 1]")};
      return;
    default:
      in.refuse("silhouette.kind", absl::StrCat(static_cast<int>(m.kind())), "SMOOTH or BULGE");
  }
}

void read_transform(const v1::Transform& m, Node& node, FieldReader& in) {
  node.kind = NodeKind::kTransform;
  if (!m.matrix().empty()) {
    if (!m.translation().empty() || !m.rotation().empty() || !m.scale().empty()) {
      in.refuse("matrix", "[stated]", "either a matrix or translation, rotation and scale, not both");
    }
    if (!in.has_size("matrix", m.matrix(), 12, false)) return;
    double rows[12];
    for (int i = 0; i < 12; ++i) rows[i] = in.coordinate(absl::StrCat("matrix.", i), m.matrix(i));
    node.frame = {{{{rows[0], rows[1], rows[2]}, {rows[4], rows[5], rows[6]}, {rows[8], rows[9], rows[10]}}},
                  {rows[3], rows[7], rows[11]}};
  } else {
    dvec3 scale{1, 1, 1};
    if (m.scale_size() == 1) {
      scale.x = scale.y = scale.z = in.coordinate("scale", m.scale(0));
    } else {
      scale = in.point("scale", m.scale(), scale);
    }
    Affine rotation;
    if (in.has_size("rotation", m.rotation(), 4, true)) {
      const dvec3 axis{in.coordinate("rotation.0", m.rotation(0)), in.coordinate("rotation.1", m.rotation(1)),
                       in.coordinate("rotation.2", m.rotation(2))};
      if (length(axis) > 0) {
        rotation = Affine::rotation(axis, in.coordinate("rotation.3", m.rotation(3)) * kRadians);
      } else {
        in.refuse("rotation", "(0, 0, 0, ...)", "an axis of a length that is not 0");
      }
    }
    node.frame =
        Affine::translation(in.point("translation", m.translation())).after(rotation).after(Affine::scale(scale));
  }
  if (!in.status().ok()) return;
  const Affine::Stretch stretch = node.frame.stretch();
  if (!(stretch.least * kMaxCondition >= stretch.most) || stretch.least <= 0) {
    in.refuse(m.matrix().empty() ? "scale" : "matrix",
              absl::StrCat("(stretches by ", stretch.least, " to ", stretch.most, ")"),
              absl::StrCat("an invertible map of condition number at most ", kMaxCondition));
  }
}

}  // namespace

std::vector<const std::string*> child_references(const v1::Node& message) {
  const google::protobuf::RepeatedPtrField<std::string>* list = nullptr;
  switch (message.kind_case()) {
    case v1::Node::kSum:
      list = &message.sum().children();
      break;
    case v1::Node::kMax:
      list = &message.max().children();
      break;
    case v1::Node::kMin:
      list = &message.min().children();
      break;
    case v1::Node::kDifference:
      list = &message.difference().children();
      break;
    case v1::Node::kRicci:
      list = &message.ricci().children();
      break;
    case v1::Node::kGradient:
      list = &message.gradient().children();
      break;
    case v1::Node::kCustom:
      list = &message.custom().children();
      break;
    case v1::Node::kTransform:
      return {&message.transform().child()};
    default:
      return {};
  }
  std::vector<const std::string*> references;
  references.reserve(list->size());
  for (const std::string& child : *list) references.push_back(&child);
  return references;
}

absl::Status read_node(const v1::Node& message, Node& node) {
  FieldReader in(node);
  const auto needs_children = [&](NodeKind kind, int count, int least) {
    node.kind = kind;
    if (count < least) {
      in.refuse("children", absl::StrCat("[", count, " children]"),
                absl::StrCat("at least ", least, least == 1 ? " child" : " children"));
    }
  };
  switch (message.kind_case()) {
    case v1::Node::kSphere:
      node.shape = Shape::kSphere;
      node.frame = Affine::translation(in.point("center", message.sphere().center()));
      node.size = {in.positive("radius", message.sphere().radius())};
      node.range = in.positive("range", message.sphere().range());
      break;
    case v1::Node::kSegment:
      read_segment(message.segment(), node, in);
      break;
    case v1::Node::kBox:
      read_box(message.box(), node, in);
      break;
    case v1::Node::kCylinder:
      read_cylinder(message.cylinder(), node, in);
      break;
    case v1::Node::kTorus: {
      const v1::Torus& m = message.torus();
      const dvec3 center = in.point("center", m.center());
      const dvec3 axis = in.direction("axis", m.axis(), {0, 0, 1});
      node.shape = Shape::kTorus;
      node.size = {in.positive("major_radius", m.major_radius()), in.positive("minor_radius", m.minor_radius())};
      node.range = in.positive("range", m.range());
      if (in.status().ok()) node.frame = Affine::frame(center, axis);
      break;
    }
    case v1::Node::kEllipsoid: {
      const dvec3 axes = in.lengths("semi_axes", message.ellipsoid().semi_axes());
      node.shape = Shape::kEllipsoid;
      node.frame = Affine::translation(in.point("center", message.ellipsoid().center()));
      node.size = {axes.x, axes.y, axes.z};
      node.range = in.positive("range", message.ellipsoid().range());
      break;
    }
    case v1::Node::kSum:
      needs_children(NodeKind::kSum, message.sum().children_size(), 1);
      break;
    case v1::Node::kMax:
      needs_children(NodeKind::kMax, message.max().children_size(), 1);
      break;
    case v1::Node::kMin:
      needs_children(NodeKind::kMin, message.min().children_size(), 1);
      break;
    case v1::Node::kDifference:
      needs_children(NodeKind::kDifference, message.difference().children_size(), 2);
      break;
    case v1::Node::kRicci:
      needs_children(NodeKind::kRicci, message.ricci().children_size(), 1);
      node.exponent = in.number("exponent", message.ricci().exponent(), 1, 64, "an exponent within [1, 64]");
      break;
    case v1::Node::kGradient:
      needs_children(NodeKind::kGradient, message.gradient().children_size(), 1);
      read_opening(message.gradient().opening(), node, in);
      read_silhouette(message.gradient().silhouette(), node, in);
      break;
    case v1::Node::kTransform:
      read_transform(message.transform(), node, in);
      break;
    default:
      in.refuse("kind", "(absent)",
                "one of sphere, segment, box, cylinder, torus, ellipsoid, sum, max, min, difference, ricci, gradient, "
                "transform");
  }
  return in.status();
}

}  // namespace isofield::blobtree
