#pragma once

#include <google/protobuf/message.h>

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "isofield/import.h"

namespace isofield {

// An object for --json, built field by field. Keys keep the order in which they are set; fields of messages keep the
// order of the .proto files. Numbers are JSON numbers, 64-bit ones too; infinities and NaN are null.
class JsonObject {
 public:
  JsonObject() = default;
  // Starts with the fields of a message, named as in the .proto files. Fields that are not set have their defaults, but
  // optional ones and messages are left out then. Enum values are written as names, bytes as Base64.
  explicit JsonObject(const google::protobuf::Message& message);

  JsonObject& set(const std::string& key, double value);
  template <std::integral Number>
  JsonObject& set(const std::string& key, Number value) {
    return set_text(key, std::to_string(value));
  }
  JsonObject& set(const std::string& key, bool value) { return set_text(key, value ? "true" : "false"); }
  JsonObject& set(const std::string& key, const std::string& value);
  JsonObject& set(const std::string& key, const char* value) { return set(key, std::string(value)); }
  JsonObject& set(const std::string& key, const JsonObject& value) { return set_text(key, value.text()); }
  JsonObject& set(const std::string& key, const std::vector<std::string>& values);
  JsonObject& set(const std::string& key, const std::vector<double>& values);
  JsonObject& set(const std::string& key, const std::vector<JsonObject>& values);
  JsonObject& set(const std::string& key, const google::protobuf::Message& message) {
    return set(key, JsonObject(message));
  }

  // The object on one line.
  std::string text() const;
  // Prints text() as a line on the standard output.
  void print() const;

 private:
  // A key that is there already keeps its place.
  JsonObject& set_text(const std::string& key, std::string text);

  std::vector<std::pair<std::string, std::string>> fields_;
};

// Prints a message as JsonObject writes it, as a line on the standard output.
void print_json(const google::protobuf::Message& message);

JsonObject to_json(const ImportReport& report);

}  // namespace isofield
