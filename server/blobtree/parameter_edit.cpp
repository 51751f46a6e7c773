#include "blobtree/parameter_edit.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>

#include <set>

#include "base/quoted.h"

namespace isofield::blobtree {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

absl::Status refuse(const ParameterEdit& edit, const std::string& why) {
  return absl::InvalidArgumentError(absl::StrCat(base::printable(edit.node, base::kQuotedCharacters), ".",
                                                 base::printable(edit.field, base::kQuotedCharacters), ": ", why));
}

// The message of the node's kind: what is set in the oneof.
Message* kind_of(v1::Node& node) {
  const auto* oneof = v1::Node::descriptor()->FindOneofByName("kind");
  const FieldDescriptor* field = node.GetReflection()->GetOneofFieldDescriptor(node, oneof);
  return field ? node.GetReflection()->MutableMessage(&node, field) : nullptr;
}

std::string numeric_fields(const Message& message) {
  std::vector<std::string> names;
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message.GetDescriptor()->field(i);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) names.push_back(field->name());
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    for (int j = 0; j < field->message_type()->field_count(); ++j) {
      const FieldDescriptor* inner = field->message_type()->field(j);
      if (inner->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
        names.push_back(absl::StrCat(field->name(), ".", inner->name()));
      }
    }
  }
  return names.empty() ? "this node has no numbers" : absl::StrCat("expected one of ", absl::StrJoin(names, ", "));
}

// The element that ".1" or ".y" names; -1: none.
int element_of(const std::string& name, int size) {
  int index = -1;
  if (size == 3 && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
    index = name[0] - 'x';
  else if (!absl::SimpleAtoi(name, &index))
    return -1;
  return index < size ? index : -1;
}

absl::Status apply(const ParameterEdit& edit, v1::Node& node) {
  Message* message = kind_of(node);
  const std::vector<std::string> path = absl::StrSplit(edit.field, '.');
  if (!message) return refuse(edit, "the node has no kind");
  std::size_t at = 0;
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(path[0]);
  if (field && field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && path.size() > 1) {
    const std::string fields = numeric_fields(*message);
    message = message->GetReflection()->MutableMessage(message, field);
    field = message->GetDescriptor()->FindFieldByName(path[at = 1]);
    if (!field) return refuse(edit, absl::StrCat("no such field; ", fields));
  }
  if (!field || field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) {
    return refuse(edit, absl::StrCat("no such numeric field; ", numeric_fields(*message)));
  }
  const auto* reflection = message->GetReflection();
  const bool has_element = path.size() == at + 2;
  if (path.size() > at + 2) return refuse(edit, absl::StrCat("no such field; ", numeric_fields(*message)));
  if (!field->is_repeated()) {
    if (has_element || edit.values.size() != 1) return refuse(edit, "expected one number for one field");
    reflection->SetDouble(message, field, edit.values[0]);
    return absl::OkStatus();
  }
  if (has_element) {
    const int size = reflection->FieldSize(*message, field);
    const int element = element_of(path[at + 1], size);
    if (element < 0 || edit.values.size() != 1) {
      return refuse(edit, absl::StrCat("expected one number for one of the ", size, " elements that the scene states"));
    }
    reflection->SetRepeatedDouble(message, field, element, edit.values[0]);
    return absl::OkStatus();
  }
  reflection->ClearField(message, field);
  for (const double value : edit.values) reflection->AddDouble(message, field, value);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::vector<std::uint32_t>> apply_edits(const std::vector<ParameterEdit>& edits, v1::Scene& scene) {
  absl::flat_hash_map<std::string, int> names;
  for (int i = 0; i < scene.nodes_size(); ++i) {
    if (!scene.nodes(i).name().empty()) names.emplace(scene.nodes(i).name(), i);
  }
  v1::Scene edited = scene;
  std::set<std::uint32_t> changed;
  for (const ParameterEdit& edit : edits) {
    int index = -1;
    if (!edit.node.empty() && edit.node[0] == '#') {
      if (!absl::SimpleAtoi(edit.node.substr(1), &index)) index = -1;
    } else if (const auto it = names.find(edit.node); it != names.end()) {
      index = it->second;
    }
    if (index < 0 || index >= edited.nodes_size()) {
      return refuse(edit, absl::StrCat("no such node; expected a node's name, or #0 to #", edited.nodes_size() - 1));
    }
    if (absl::Status s = apply(edit, *edited.mutable_nodes(index)); !s.ok()) return s;
    changed.insert(static_cast<std::uint32_t>(index));
  }
  scene = std::move(edited);
  return std::vector<std::uint32_t>(changed.begin(), changed.end());
}

}  // namespace isofield::blobtree
