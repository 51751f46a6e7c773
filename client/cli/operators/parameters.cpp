#include "operators/parameters.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>

#include "nearest_name.h"

namespace isofield {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// The place of a parameter: a field of the message, or of a message in it.
struct Place {
  const FieldDescriptor* outer;  // nullptr: in the message itself
  const FieldDescriptor* field;

  std::string name() const { return outer ? absl::StrCat(outer->name(), ".", field->name()) : field->name(); }
  std::string json_name() const {
    return outer ? absl::StrCat(outer->json_name(), ".", field->json_name()) : field->json_name();
  }
};

bool is_message(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

// Returns a message's first enum, which says what kind it is, or nullptr if it has none.
const FieldDescriptor* enum_of(const FieldDescriptor& message) {
  for (int i = 0; i < message.message_type()->field_count(); ++i) {
    const FieldDescriptor* field = message.message_type()->field(i);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM) return field;
  }
  return nullptr;
}

std::vector<Place> places_of(const Message& message) {
  std::vector<Place> places;
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message.GetDescriptor()->field(i);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) continue;  // children
    places.push_back({nullptr, field});
    if (!is_message(*field)) continue;
    for (int j = 0; j < field->message_type()->field_count(); ++j) {
      places.push_back({field, field->message_type()->field(j)});
    }
  }
  return places;
}

absl::Status refuse(const std::string& assignment, const std::string& expected) {
  return absl::InvalidArgumentError(absl::StrCat("--param ", assignment.substr(0, 80), ": expected ", expected));
}

std::string value_names(const EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(absl::AsciiStrToLower(type.value(i)->name()));
  }
  return absl::StrCat("one of ", absl::StrJoin(names, ", "));
}

// Sets one value, or appends it to a list. Returns false if the text is not a value of the field's type.
bool put_value(absl::string_view text, const FieldDescriptor& field, Message& message) {
  const auto* reflection = message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      double value = 0;
      if (!absl::SimpleAtod(text, &value)) return false;
      field.is_repeated() ? reflection->AddDouble(&message, &field, value)
                          : reflection->SetDouble(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_FLOAT: {
      float value = 0;
      if (!absl::SimpleAtof(text, &value)) return false;
      field.is_repeated() ? reflection->AddFloat(&message, &field, value)
                          : reflection->SetFloat(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_UINT32: {
      std::uint32_t value = 0;
      if (!absl::SimpleAtoi(text, &value)) return false;
      reflection->SetUInt32(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_BOOL: {
      bool value = false;
      if (!absl::SimpleAtob(text, &value)) return false;
      reflection->SetBool(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* value = field.enum_type()->FindValueByName(absl::AsciiStrToUpper(text));
      if (!value || value->number() == 0) return false;
      reflection->SetEnum(&message, &field, value);
      return true;
    }
    default:
      return false;
  }
}

std::string expected_value(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_ENUM:
      return value_names(*field.enum_type());
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    default: {
      const char* kind = field.is_repeated()                                   ? "numbers separated by commas"
                         : field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 ? "a whole number"
                                                                               : "a number";
      const std::string accepts = range_of(field).accepts;
      return accepts.empty() ? kind : absl::StrCat(kind, ": ", accepts);
    }
  }
}

}  // namespace

std::vector<std::string> parameter_names(const Message& message) {
  std::vector<std::string> names;
  for (const Place& place : places_of(message)) names.push_back(place.name());
  return names;
}

std::vector<Parameter> describe_parameters(const Message& message) {
  std::vector<Parameter> parameters;
  for (const Place& place : places_of(message)) {
    // A message's name stands for the enum in it, which is listed by itself.
    if (!is_message(*place.field)) parameters.push_back({place.name(), range_of(*place.field)});
  }
  return parameters;
}

absl::Status set_parameter(const std::string& assignment, Message& message) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) return refuse(assignment, "NAME=VALUE");
  const absl::string_view name = absl::string_view(assignment).substr(0, equals);
  const absl::string_view value = absl::string_view(assignment).substr(equals + 1);
  // A whole name is preferred to the last part of one.
  std::vector<Place> found, nested;
  for (const Place& place : places_of(message)) {
    const auto is = [&](const std::string& own) { return absl::EqualsIgnoreCase(own, name); };
    if (is(place.name()) || is(place.json_name())) found.push_back(place);
    if (place.outer && (is(place.field->name()) || is(place.field->json_name()))) nested.push_back(place);
  }
  if (found.empty()) found = nested;
  if (found.size() > 1) {
    return refuse(assignment, absl::StrCat(found[0].name(), " or ", found[1].name(), " as the name"));
  }
  if (found.empty()) {
    const std::vector<std::string> names = parameter_names(message);
    // Names within messages count by themselves too: for "teta0" the nearest one is "theta0", which is opening.theta0.
    std::vector<std::string> all = names;
    for (const Place& place : places_of(message)) all.push_back(place.field->name());
    return refuse(assignment, names.empty() ? "no parameter: this operator has none"
                                            : absl::StrCat("one of the names ", absl::StrJoin(names, ", "),
                                                           did_you_mean(name, all)));
  }
  Place place = found[0];
  if (is_message(*place.field)) {
    const FieldDescriptor* kind = enum_of(*place.field);
    if (!kind) return refuse(assignment, "the name of a number");
    place = {place.field, kind};
  }
  Message& owner = place.outer ? *message.GetReflection()->MutableMessage(&message, place.outer) : message;
  if (!place.field->is_repeated()) {
    return put_value(value, *place.field, owner) ? absl::OkStatus() : refuse(assignment, expected_value(*place.field));
  }
  owner.GetReflection()->ClearField(&owner, place.field);
  for (const absl::string_view element : absl::StrSplit(value, ',', absl::SkipWhitespace())) {
    if (!put_value(element, *place.field, owner)) return refuse(assignment, expected_value(*place.field));
  }
  return absl::OkStatus();
}

}  // namespace isofield
