#pragma once

#include <google/protobuf/message.h>

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "isofield/import.h"

namespace isofield {

// Builds a JSON object for --json, field by field. Keys keep the order in which they are set; fields of messages keep
// the order of the .proto files. Numbers, also those of 64 bits, are JSON numbers; infinities and NaN are null.
class JsonObject {
 public:
  JsonObject() = default;
  // Starts with the fields of a message, named as in the .proto files. A field that is not set has its default, but an
  // optional field or a message that is not set is left out. Enum values are written as names, bytes as Base64.
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

  // Returns the object as JSON on one line.
  std::string text() const;
  // Prints text() as a line on the standard output.
  void print() const;

 private:
  // Sets a key to a value that is JSON already. A key that is there already keeps its place.
  JsonObject& set_text(const std::string& key, std::string text);

  std::vector<std::pair<std::string, std::string>> fields_;
};

// Prints a message as JsonObject writes it, as a line on the standard output.
void print_json(const google::protobuf::Message& message);

// Converts the report of an import; its findings become an object of counts.
JsonObject to_json(const ImportReport& report);

}  // namespace isofield
