#include "json_output.h"

#include <google/protobuf/util/json_util.h>

#include <cstdio>

namespace isofield {
namespace {

std::string format(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string out;
  // Our own messages always have a JSON form.
  (void)google::protobuf::util::MessageToJsonString(message, &out, options);
  return out;
}

}  // namespace

JsonObject::JsonObject(const google::protobuf::Message& message) {
  (void)google::protobuf::util::JsonStringToMessage(format(message), &fields_);
}

JsonObject& JsonObject::set(const std::string& key, const std::vector<std::string>& values) {
  auto& list = *(*fields_.mutable_fields())[key].mutable_list_value();
  for (const std::string& value : values) list.add_values()->set_string_value(value);
  return *this;
}

JsonObject& JsonObject::set(const std::string& key, double value) {
  (*fields_.mutable_fields())[key].set_number_value(value);
  return *this;
}

JsonObject& JsonObject::set(const std::string& key, const std::string& value) {
  (*fields_.mutable_fields())[key].set_string_value(value);
  return *this;
}

JsonObject& JsonObject::set(const std::string& key, const JsonObject& value) {
  *(*fields_.mutable_fields())[key].mutable_struct_value() = value.fields_;
  return *this;
}

JsonObject& JsonObject::set(const std::string& key, const google::protobuf::Message& message) {
  (void)google::protobuf::util::JsonStringToMessage(format(message),
                                                    (*fields_.mutable_fields())[key].mutable_struct_value());
  return *this;
}

void JsonObject::print() const {
  print_json(fields_);
}

void print_json(const google::protobuf::Message& message) {
  std::printf("%s\n", format(message).c_str());
}

JsonObject to_json(const ImportReport& report) {
  JsonObject out;
  out.set("format", report.format)
      .set("read", static_cast<double>(report.read))
      .set("pieces", static_cast<double>(report.pieces));
  JsonObject findings;
  for (const auto& finding : report.findings) findings.set(finding.what, static_cast<double>(finding.count));
  out.set("findings", findings);
  return out;
}

}  // namespace isofield
