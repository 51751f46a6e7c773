#include "json_output.h"

#include <absl/strings/escaping.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "utf8.h"

namespace isofield {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// Returns the shortest decimal number that reads back as the same value, or null if the value is not finite.
template <class Number>
std::string number(Number value) {
  if (!std::isfinite(value)) return "null";
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr);
}

// Returns the text as a JSON string. JSON is UTF-8, but names of files need not be: other bytes become U+FFFD.
std::string quoted(absl::string_view text) {
  std::string out = "\"";
  for (const char c : valid_utf8(text)) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      absl::StrAppend(&out, "\\u", absl::Hex(c, absl::kZeroPad4));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

template <class Items, class Format>
std::string list(const Items& items, const Format& format) {
  std::string out = "[";
  for (const auto& item : items) absl::StrAppend(&out, out.size() > 1 ? "," : "", format(item));
  return out + "]";
}

// Returns the value of a field as JSON; if the field is a list, the value of its element `i`.
std::string value_of(const Message& message, const FieldDescriptor* field, int i) {
  const Reflection& r = *message.GetReflection();
  const bool is_list = field->is_repeated();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return absl::StrCat(is_list ? r.GetRepeatedInt32(message, field, i) : r.GetInt32(message, field));
    case FieldDescriptor::CPPTYPE_INT64:
      return absl::StrCat(is_list ? r.GetRepeatedInt64(message, field, i) : r.GetInt64(message, field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return absl::StrCat(is_list ? r.GetRepeatedUInt32(message, field, i) : r.GetUInt32(message, field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return absl::StrCat(is_list ? r.GetRepeatedUInt64(message, field, i) : r.GetUInt64(message, field));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number(is_list ? r.GetRepeatedDouble(message, field, i) : r.GetDouble(message, field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return number(is_list ? r.GetRepeatedFloat(message, field, i) : r.GetFloat(message, field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return (is_list ? r.GetRepeatedBool(message, field, i) : r.GetBool(message, field)) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return quoted((is_list ? r.GetRepeatedEnum(message, field, i) : r.GetEnum(message, field))->name());
    case FieldDescriptor::CPPTYPE_STRING: {
      std::string scratch;
      const std::string& text = is_list ? r.GetRepeatedStringReference(message, field, i, &scratch)
                                        : r.GetStringReference(message, field, &scratch);
      return quoted(field->type() == FieldDescriptor::TYPE_BYTES ? absl::Base64Escape(text) : text);
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return JsonObject(is_list ? r.GetRepeatedMessage(message, field, i) : r.GetMessage(message, field)).text();
  }
  return "null";
}

}  // namespace

JsonObject::JsonObject(const Message& message) {
  const Reflection& reflection = *message.GetReflection();
  for (int n = 0; n < message.GetDescriptor()->field_count(); ++n) {
    const FieldDescriptor* field = message.GetDescriptor()->field(n);
    if (field->is_repeated()) {
      std::string text = "[";
      for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
        absl::StrAppend(&text, i > 0 ? "," : "", value_of(message, field, i));
      }
      set_text(field->name(), text + "]");
    } else if (!field->has_presence() || reflection.HasField(message, field)) {
      set_text(field->name(), value_of(message, field, 0));
    }
  }
}

JsonObject& JsonObject::set(const std::string& key, double value) {
  return set_text(key, number(value));
}

JsonObject& JsonObject::set(const std::string& key, const std::string& value) {
  return set_text(key, quoted(value));
}

JsonObject& JsonObject::set(const std::string& key, const std::vector<std::string>& values) {
  return set_text(key, list(values, quoted));
}

JsonObject& JsonObject::set(const std::string& key, const std::vector<double>& values) {
  return set_text(key, list(values, number<double>));
}

JsonObject& JsonObject::set(const std::string& key, const std::vector<JsonObject>& values) {
  return set_text(key, list(values, [](const JsonObject& value) { return value.text(); }));
}

JsonObject& JsonObject::set_text(const std::string& key, std::string text) {
  const auto there =
      std::find_if(fields_.begin(), fields_.end(), [&](const auto& field) { return field.first == key; });
  if (there != fields_.end()) {
    there->second = std::move(text);
  } else {
    fields_.emplace_back(key, std::move(text));
  }
  return *this;
}

std::string JsonObject::text() const {
  std::string out = "{";
  for (const auto& [key, value] : fields_) {
    absl::StrAppend(&out, out.size() > 1 ? "," : "", quoted(key), ":", value);
  }
  return out + "}";
}

void JsonObject::print() const {
  std::printf("%s\n", text().c_str());
}

void print_json(const Message& message) {
  JsonObject(message).print();
}

JsonObject to_json(const ImportReport& report) {
  JsonObject findings;
  for (const auto& finding : report.findings) findings.set(finding.what, finding.count);
  return JsonObject()
      .set("format", report.format)
      .set("read", report.read)
      .set("pieces", report.pieces)
      .set("findings", findings);
}

}  // namespace isofield
