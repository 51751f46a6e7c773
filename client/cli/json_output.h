#pragma once

#include <google/protobuf/message.h>
#include <google/protobuf/struct.pb.h>

#include <string>
#include <vector>

#include "isofield/import.h"

namespace isofield {

// An object for --json, built field by field.
class JsonObject {
 public:
  JsonObject() = default;
  // Starts with the fields of a message, written as set() writes them.
  explicit JsonObject(const google::protobuf::Message& message);

  JsonObject& set(const std::string& key, double value);
  JsonObject& set(const std::string& key, const std::string& value);
  JsonObject& set(const std::string& key, const JsonObject& value);
  JsonObject& set(const std::string& key, const std::vector<std::string>& values);
  // A message in proto3 JSON.
  JsonObject& set(const std::string& key, const google::protobuf::Message& message);

  // One line on the standard output.
  void print() const;

 private:
  google::protobuf::Struct fields_;
};

// One line on the standard output: proto3 JSON with the contract's names and every field present.
void print_json(const google::protobuf::Message& message);

JsonObject to_json(const ImportReport& report);

}  // namespace isofield
