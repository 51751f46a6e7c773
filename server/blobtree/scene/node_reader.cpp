#include "blobtree/scene/node_reader.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <cmath>
#include <numbers>

#include "base/quoted.h"
#include "blobtree/scene/field_reader.h"
#include "blobtree/scene/operator_reader.h"

namespace isofield::blobtree {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// The law of a primitive's field, and its range where it has one.
template <class Primitive>
void read_law(const Primitive& m, Node& node, FieldReader& in) {
  switch (m.law()) {
    case v1::FIELD_LAW_UNSPECIFIED:
    case v1::POSITIVE:
      node.range = in.positive("range", m.range());
      return;
    case v1::SIGNED:
      node.law = operators::Law::kSigned;
      if (m.range() != 0) in.refuse("range", absl::StrCat(m.range()), "none: a SIGNED field has no range");
      return;
    default:
      in.refuse("law", absl::StrCat(static_cast<int>(m.law())), "POSITIVE or SIGNED");
  }
}

void read_segment(const v1::Segment& m, Node& node, FieldReader& in) {
  const dvec3 a = in.stated_point("a", m.a()), b = in.stated_point("b", m.b());
  const dvec3 axis = b - a;
  node.shape = Shape::kSegment;
  node.size = {length(axis), in.positive("radius_a", m.radius_a()), in.positive("radius_b", m.radius_b())};
  read_law(m, node, in);
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
  read_law(m, node, in);
}

void read_cylinder(const v1::Cylinder& m, Node& node, FieldReader& in) {
  const dvec3 a = in.stated_point("a", m.a()), b = in.stated_point("b", m.b());
  const dvec3 axis = b - a;
  node.shape = Shape::kCylinder;
  node.size = {length(axis) / 2, in.positive("radius", m.radius())};
  read_law(m, node, in);
  if (node.size[0] >= kMinLength) {
    node.frame = Affine::frame((a + b) * 0.5, axis);
  } else {
    in.refuse("b", "a", "a point that differs from a");
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

void read_custom(const std::string& name, const OperatorTable& custom, Node& node, FieldReader& in) {
  const auto it = custom.find(name);
  if (it != custom.end()) {
    node.op = it->second;
    return;
  }
  constexpr char kExpected[] = "the name of a custom operator that is put before the scene";
  name.empty() ? in.miss("operator", kExpected) : in.refuse("operator", base::quoted(name), kExpected);
}

std::string kind_names() {
  const auto* oneof = v1::Node::descriptor()->FindOneofByName("kind");
  std::vector<std::string> names;
  for (int i = 0; i < oneof->field_count(); ++i) names.emplace_back(oneof->field(i)->name());
  return absl::StrJoin(names, ", ");
}

}  // namespace

std::string node_path(std::size_t index, const v1::Node& message) {
  return message.name().empty() ? absl::StrCat("nodes[", index, "]")
                                : absl::StrCat("nodes[", index, "] ", base::quoted(message.name()));
}

std::vector<const std::string*> child_references(const v1::Node& message) {
  static const google::protobuf::OneofDescriptor* const kKind = v1::Node::descriptor()->FindOneofByName("kind");
  std::vector<const std::string*> references;
  if (message.has_transform()) return {&message.transform().child()};
  if (message.has_soften()) return {&message.soften().child()};
  if (message.has_harden()) return {&message.harden().child()};
  const auto* kind = message.GetReflection()->GetOneofFieldDescriptor(message, kKind);
  if (!kind) return {};
  const auto& body = message.GetReflection()->GetMessage(message, kind);
  // Operators have them as their first field.
  const auto* children = body.GetDescriptor()->FindFieldByNumber(1);
  if (children->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_STRING || !children->is_repeated()) return {};
  const auto* reflection = body.GetReflection();
  std::string scratch;  // unused: the message holds strings as they are
  for (int i = 0; i < reflection->FieldSize(body, children); ++i) {
    references.push_back(&reflection->GetRepeatedStringReference(body, children, i, &scratch));
  }
  return references;
}

absl::Status read_node(const v1::Node& message, const OperatorTable& custom, Node& node) {
  FieldReader in(node.path);
  switch (message.kind_case()) {
    case v1::Node::kSphere:
      node.shape = Shape::kSphere;
      node.frame = Affine::translation(in.point("center", message.sphere().center()));
      node.size = {in.positive("radius", message.sphere().radius())};
      read_law(message.sphere(), node, in);
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
      read_law(m, node, in);
      if (in.status().ok()) node.frame = Affine::frame(center, axis);
      break;
    }
    case v1::Node::kEllipsoid: {
      const dvec3 axes = in.lengths("semi_axes", message.ellipsoid().semi_axes());
      node.shape = Shape::kEllipsoid;
      node.frame = Affine::translation(in.point("center", message.ellipsoid().center()));
      node.size = {axes.x, axes.y, axes.z};
      read_law(message.ellipsoid(), node, in);
      break;
    }
    case v1::Node::kTransform:
      read_transform(message.transform(), node, in);
      break;
    case v1::Node::kSoften:
      node.kind = NodeKind::kSoften;
      node.range = in.positive("range", message.soften().range());
      break;
    case v1::Node::kHarden:
      node.kind = NodeKind::kHarden;
      node.law = operators::Law::kSigned;
      break;
    case v1::Node::kCustom:
      node.kind = NodeKind::kOperator;
      read_custom(message.custom().operator_(), custom, node, in);
      break;
    case v1::Node::KIND_NOT_SET:
      in.miss("kind", absl::StrCat("one of ", kind_names()));
      break;
    default:
      node.kind = NodeKind::kOperator;
      node.op = read_operator(message, in);
  }
  if (in.status().ok() && node.op) node.law = operators::law_of(node.op->kind);
  return in.status();
}

}  // namespace isofield::blobtree
