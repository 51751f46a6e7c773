#include "blobtree/scene/parameter_edit.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>

#include <set>

#include "base/nearest_name.h"
#include "base/quoted.h"

namespace isofield::blobtree {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

absl::Status refuse(const ParameterEdit& edit, const std::string& why) {
  return absl::InvalidArgumentError(absl::StrCat(base::printable(edit.node, base::kQuotedCharacters), ".",
                                                 base::printable(edit.field, base::kQuotedCharacters), ": ", why));
}

// Returns the field of the node's kind, which is the one that is set in the oneof, or nullptr if none is.
const FieldDescriptor* kind_of(const v1::Node& node) {
  return node.GetReflection()->GetOneofFieldDescriptor(node, v1::Node::descriptor()->FindOneofByName("kind"));
}

// Returns the field of this name, or nullptr if there is none. The name may be that of scene.proto ("radius_a") or that
// of JSON ("radiusA").
const FieldDescriptor* field_of(const Descriptor& type, const std::string& name) {
  const FieldDescriptor* field = type.FindFieldByName(name);
  for (int i = 0; field == nullptr && i < type.field_count(); ++i) {
    if (type.field(i)->json_name() == name) field = type.field(i);
  }
  return field;
}

// Returns the names of the numeric fields of a kind of node. Fields of a message within it are named like
// "opening.alpha0".
std::vector<std::string> numeric_fields(const Descriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) names.push_back(field->name());
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    for (const std::string& inner : numeric_fields(*field->message_type())) {
      names.push_back(absl::StrCat(field->name(), ".", inner));
    }
  }
  return names;
}

absl::Status refuse_field(const ParameterEdit& edit, const FieldDescriptor& kind) {
  const std::vector<std::string> names = numeric_fields(*kind.message_type());
  if (names.empty()) return refuse(edit, absl::StrCat("a node of kind ", kind.name(), " has no numbers"));
  return refuse(edit,
                absl::StrCat("a node of kind ", kind.name(), " has no such numeric field",
                             base::did_you_mean(edit.field, names), "; expected one of ", absl::StrJoin(names, ", ")));
}

// Returns the index of the element that "1" or "y" names, or a negative number if there is none.
int element_of(const std::string& name, int size) {
  int index = -1;
  if (size == 3 && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
    index = name[0] - 'x';
  else if (!absl::SimpleAtoi(name, &index))
    return -1;
  return index < size ? index : -1;
}

absl::Status apply(const ParameterEdit& edit, v1::Node& node) {
  const FieldDescriptor* const kind = kind_of(node);
  if (!kind) return refuse(edit, "the node has no kind");
  Message* message = node.GetReflection()->MutableMessage(&node, kind);
  const std::vector<std::string> path = absl::StrSplit(edit.field, '.');
  std::size_t at = 0;
  const FieldDescriptor* field = field_of(*kind->message_type(), path[0]);
  if (field && field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && path.size() > 1) {
    const FieldDescriptor* inner = field_of(*field->message_type(), path[at = 1]);
    if (!inner || inner->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) return refuse_field(edit, *kind);
    message = message->GetReflection()->MutableMessage(message, field);
    field = inner;
  }
  if (!field || field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE || path.size() > at + 2) {
    return refuse_field(edit, *kind);
  }
  const auto* reflection = message->GetReflection();
  const bool has_element = path.size() == at + 2;
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
      std::vector<std::string> all;
      for (const v1::Node& node : edited.nodes()) all.push_back(node.name());
      return refuse(edit, absl::StrCat("no such node; expected a node's name, or #0 to #", edited.nodes_size() - 1,
                                       base::did_you_mean(edit.node, all)));
    }
    if (absl::Status s = apply(edit, *edited.mutable_nodes(index)); !s.ok()) return s;
    changed.insert(static_cast<std::uint32_t>(index));
  }
  scene = std::move(edited);
  return std::vector<std::uint32_t>(changed.begin(), changed.end());
}

}  // namespace isofield::blobtree
