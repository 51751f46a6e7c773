#include "catalog/built_in_operators.h"

namespace isofield::catalog {
namespace {

const google::protobuf::OneofDescriptor& kinds() {
  return *v1::Operator::descriptor()->FindOneofByName("kind");
}

}  // namespace

const std::vector<std::string>& built_in_names() {
  static const auto* const kNames = [] {
    auto* names = new std::vector<std::string>;
    for (int i = 0; i < kinds().field_count(); ++i) names->push_back(kinds().field(i)->name());
    return names;
  }();
  return *kNames;
}

std::optional<v1::Operator> built_in_operator(const std::string& name) {
  const google::protobuf::FieldDescriptor* field = v1::Operator::descriptor()->FindFieldByName(name);
  if (!field || field->containing_oneof() != &kinds()) return std::nullopt;
  v1::Operator message;
  message.GetReflection()->MutableMessage(&message, field);
  return message;
}

std::string kind_name(const v1::Operator& message) {
  const auto* field = message.GetReflection()->GetOneofFieldDescriptor(message, &kinds());
  return field ? field->name() : "";
}

}  // namespace isofield::catalog
