#include "blobtree/scene/operator_reader.h"

#include <absl/strings/str_join.h>

#include <string>
#include <vector>

namespace isofield::blobtree {
namespace {

using google::protobuf::FieldDescriptor;
using operators::Operator;

std::string kind_names() {
  std::vector<std::string> names;
  for (const operators::Traits& kind : operators::kKinds) names.emplace_back(kind.name);
  return absl::StrJoin(names, ", ");
}

// Refuses an operator with children, because operands come with the nodes that use the operator.
void refuse_children(const v1::Operator& message, base::FieldReader& in) {
  const FieldDescriptor* kind =
      message.GetReflection()->GetOneofFieldDescriptor(message, v1::Operator::descriptor()->FindOneofByName("kind"));
  const auto& body = message.GetReflection()->GetMessage(message, kind);
  const FieldDescriptor* children = body.GetDescriptor()->FindFieldByName("children");
  if (children && body.GetReflection()->FieldSize(body, children) > 0) {
    in.refuse(absl::StrCat(std::string(kind->name()), ".children"), "[stated]", "no children");
  }
}

}  // namespace

absl::StatusOr<std::shared_ptr<const Operator>> read_operator(const v1::Operator& message) {
  const std::string path = "operator";
  base::FieldReader in(path);
  std::shared_ptr<const Operator> op;
  switch (message.kind_case()) {
#define ISOFIELD_CASE(Name, field)                        \
  case v1::Operator::k##Name:                             \
    op = read_kind<operators::Name>(message.field(), in); \
    break;
    ISOFIELD_OPERATORS(ISOFIELD_CASE)
#undef ISOFIELD_CASE
    case v1::Operator::KIND_NOT_SET:
      in.miss("kind", absl::StrCat("one of ", kind_names()));
      break;
  }
  if (op) refuse_children(message, in);
  if (!in.status().ok()) return in.status();
  return op;
}

Operator unread_operator(const v1::Operator& message) {
  switch (message.kind_case()) {
#define ISOFIELD_CASE(Name, field) \
  case v1::Operator::k##Name:      \
    return operators::Name{};
    ISOFIELD_OPERATORS(ISOFIELD_CASE)
#undef ISOFIELD_CASE
    case v1::Operator::KIND_NOT_SET:
      break;
  }
  return {};
}

absl::StatusOr<operators::Opening> read_opening(const v1::Opening& message) {
  const std::string path = "operator";
  base::FieldReader in(path);
  operators::Opening opening = operators::read_opening(message, in);
  if (!in.status().ok()) return in.status();
  return opening;
}

}  // namespace isofield::blobtree
