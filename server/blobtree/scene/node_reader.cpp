#include "blobtree/scene/node_reader.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <cmath>
#include <numbers>

#include "base/field_reader.h"
#include "base/quoted.h"
#include "blobtree/scene/operator_reader.h"

namespace isofield::blobtree {
namespace {

using base::FieldReader;

constexpr double kRadians = std::numbers::pi / 180;

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
  // Operators have their children as their first field.
  const auto* children = body.GetDescriptor()->FindFieldByNumber(1);
  if (children->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_STRING || !children->is_repeated()) return {};
  const auto* reflection = body.GetReflection();
  std::string scratch;  // not used: the message holds its strings whole
  for (int i = 0; i < reflection->FieldSize(body, children); ++i) {
    references.push_back(&reflection->GetRepeatedStringReference(body, children, i, &scratch));
  }
  return references;
}

absl::Status read_node(const v1::Node& message, const OperatorTable& custom, Node& node) {
  FieldReader in(node.path);
  // The switch leaves no kind out: the compiler refuses a field of the message that has no row in its family's table.
  switch (message.kind_case()) {
#define ISOFIELD_CASE(Name, field)                \
  case v1::Node::k##Name:                         \
    node.primitive = read_primitive(message, in); \
    node.law = node.primitive.law;                \
    break;
    ISOFIELD_PRIMITIVES(ISOFIELD_CASE)
#undef ISOFIELD_CASE
#define ISOFIELD_CASE(Name, field)                             \
  case v1::Node::k##Name:                                      \
    node.kind = NodeKind::kOperator;                           \
    node.op = read_kind<operators::Name>(message.field(), in); \
    break;
    ISOFIELD_BLENDS(ISOFIELD_CASE)
#undef ISOFIELD_CASE
    case v1::Node::kCustom:
      node.kind = NodeKind::kOperator;
      read_custom(message.custom().operator_(), custom, node, in);
      break;
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
    case v1::Node::KIND_NOT_SET:
      in.miss("kind", absl::StrCat("one of ", kind_names()));
      break;
  }
  if (in.status().ok() && node.op) node.law = node.op->law();
  return in.status();
}

}  // namespace isofield::blobtree
