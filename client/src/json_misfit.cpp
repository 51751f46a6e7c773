#include "json_misfit.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <map>

#include "nearest_name.h"

namespace isofield {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::OneofDescriptor;

// The deepest nesting that is read. No message of the .proto files needs so much, and the stack allows it.
constexpr int kMostDepth = 100;

// Returns the field of this name, which may be the one of the .proto file or the one of JSON, or nullptr where there is
// none.
const FieldDescriptor* field_of(const Descriptor& type, const std::string& name) {
  if (const FieldDescriptor* field = type.FindFieldByName(name)) return field;
  for (int i = 0; i < type.field_count(); ++i) {
    if (type.field(i)->json_name() == name) return type.field(i);
  }
  return nullptr;
}

std::vector<std::string> field_names(const Descriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

std::vector<std::string> enum_names(const EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(type.value(i)->name());
  }
  return names;
}

// Reads a text along the fields of a message type, up to the first misfit.
class Walker {
 public:
  explicit Walker(absl::string_view text) : text_(text) {}

  JsonMisfit walk(const Descriptor& type) {
    if (message(type, "", 0)) {
      skip_space();
      if (at_ < text_.size()) syntax("the end of the text");
    }
    return std::move(misfit_);
  }

 private:
  // All functions that read a part of the text return false once a misfit is found.
  bool fail(JsonMisfit::Kind kind, std::size_t at, std::string text) {
    if (misfit_.kind != JsonMisfit::Kind::kNone) return false;
    at = std::min(at, text_.size());
    const absl::string_view before = text_.substr(0, at);
    const std::size_t line_start = before.rfind('\n');
    misfit_ = {kind,
               absl::StrCat(1 + std::count(before.begin(), before.end(), '\n'), ":",
                            at - (line_start == absl::string_view::npos ? 0 : line_start + 1) + 1),
               std::move(text)};
    return false;
  }
  bool syntax(absl::string_view expected) {
    const absl::string_view rest = text_.substr(std::min(at_, text_.size()));
    const std::size_t length = std::min<std::size_t>(rest.find('\n'), 20);
    const std::string found = rest.empty() ? "the text ends" : absl::StrCat("\"", rest.substr(0, length), "\"");
    return fail(JsonMisfit::Kind::kSyntax, at_, absl::StrCat(found, " where ", expected, " was expected"));
  }
  // `path` is the place that `text` is about, such as "nodes[2].sphere".
  bool meaning(std::size_t at, const std::string& path, absl::string_view text) {
    return fail(JsonMisfit::Kind::kMeaning, at, absl::StrCat(with_name(path), text));
  }

  void skip_space() {
    while (at_ < text_.size() && absl::ascii_isspace(text_[at_])) ++at_;
  }
  bool next_is(char c) {
    skip_space();
    return at_ < text_.size() && text_[at_] == c;
  }
  bool take(char c) {
    if (!next_is(c)) return syntax(absl::StrCat("\"", std::string(1, c), "\""));
    ++at_;
    return true;
  }

  // Reads a string. Escapes are not decoded (the backslash is dropped), since the names that are looked up have none.
  bool string(std::string& out) {
    if (!next_is('"')) return syntax("a text in double quotes");
    const std::size_t start = at_++;
    out.clear();
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        ++at_;
        return true;
      }
      if (text_[at_] == '\n') break;
      if (text_[at_] == '\\') ++at_;
      if (at_ < text_.size()) out.push_back(text_[at_]);
    }
    return fail(JsonMisfit::Kind::kSyntax, start, "a text in quotes does not end on its line");
  }
  bool literal(std::string& out) {
    skip_space();
    out.clear();
    while (at_ < text_.size() && (absl::ascii_isalnum(text_[at_]) || absl::StrContains("+-._", text_.substr(at_, 1)))) {
      out.push_back(text_[at_++]);
    }
    double number = 0;
    if (out == "true" || out == "false" || out == "null") return true;
    if (!out.empty() && (absl::ascii_isdigit(out[0]) || out[0] == '-') && absl::SimpleAtod(out, &number)) return true;
    at_ -= out.size();
    return syntax("a value");
  }

  // Reads a list between brackets; `item` reads one of its items.
  template <class Item>
  bool list(char open, char close, const Item& item) {
    if (!take(open)) return false;
    if (next_is(close)) return take(close);
    while (true) {
      if (!item()) return false;
      if (next_is(close)) return take(close);
      if (!next_is(',')) return syntax(absl::StrCat("\",\" or \"", std::string(1, close), "\""));
      ++at_;
    }
  }

  bool skip_value(int depth) {
    std::string ignored;
    if (depth > kMostDepth) return syntax("less nesting");
    if (next_is('"')) return string(ignored);
    if (next_is('[')) return list('[', ']', [&] { return skip_value(depth + 1); });
    if (next_is('{')) {
      return list('{', '}', [&] { return string(ignored) && take(':') && skip_value(depth + 1); });
    }
    return literal(ignored);
  }

  bool message(const Descriptor& type, const std::string& path, int depth) {
    if (depth > kMostDepth) return syntax("less nesting");
    if (next_is('n')) return skip_value(depth);  // null
    const std::size_t start = (skip_space(), at_);
    if (!next_is('{')) {
      if (at_ >= text_.size() || !absl::StrContains("\"[-0123456789tf", text_.substr(at_, 1))) return syntax("\"{\"");
      return meaning(start, path.empty() ? "the text" : path, " is not an object; expected fields between { and }");
    }
    if (depth == 1) node_at_ = start;
    std::map<const FieldDescriptor*, std::size_t> stated;
    std::map<const OneofDescriptor*, const FieldDescriptor*> chosen;
    return list('{', '}', [&] {
      skip_space();
      const std::size_t key_at = at_;
      std::string key;
      if (!string(key) || !take(':')) return false;
      const FieldDescriptor* field = field_of(type, key);
      if (field == nullptr) return unknown_field(type, key, key_at, path);
      const std::string in = path.empty() ? key : absl::StrCat(path, ".", key);
      if (!stated.emplace(field, key_at).second) return meaning(key_at, in, " is stated twice; expected it once");
      const OneofDescriptor* oneof = next_is('n') ? nullptr : field->containing_oneof();
      if (oneof != nullptr && !chosen.emplace(oneof, field).second) {
        return meaning(
            key_at, path.empty() ? "the text" : path,
            absl::StrCat(" has both ", chosen[oneof]->name(), " and ", field->name(), "; expected one of them"));
      }
      if (next_is('n')) return skip_value(depth);
      if (!field->is_repeated() || !next_is('[')) return value(*field, in, depth);
      int index = 0;
      return list('[', ']', [&] { return value(*field, absl::StrCat(in, "[", index++, "]"), depth); });
    });
  }

  bool value(const FieldDescriptor& field, const std::string& path, int depth) {
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) return message(*field.message_type(), path, depth + 1);
    skip_space();
    const std::size_t at = at_;
    const auto refuse = [&](absl::string_view expected) {
      const absl::string_view found = text_.substr(at, at_ > at ? std::min<std::size_t>(at_ - at, 60) : 1);
      return meaning(at, path, absl::StrCat(" = ", found, ": expected ", expected));
    };
    const bool is_nested = next_is('{') || next_is('[');
    std::string text;
    double number = 0;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_STRING:
        if (is_nested) return refuse("a text in quotes");
        if (next_is('"')) return string(text);
        return literal(text) && refuse("a text in quotes");
      case FieldDescriptor::CPPTYPE_BOOL:
        if (is_nested) return refuse("true or false");
        if (next_is('"')) return string(text);
        return literal(text) && (text == "true" || text == "false" || refuse("true or false"));
      case FieldDescriptor::CPPTYPE_ENUM:
        return is_nested ? refuse(one_of(*field.enum_type())) : enum_value(*field.enum_type(), refuse);
      default:
        if (is_nested) return refuse("a number");
        if (!next_is('"')) return literal(text) && (!absl::ascii_isalpha(text[0]) || refuse("a number"));
        return string(text) && (absl::SimpleAtod(text, &number) || refuse("a number"));
    }
  }

  template <class Refuse>
  bool enum_value(const EnumDescriptor& type, const Refuse& refuse) {
    std::string text;
    if (!next_is('"')) return literal(text) && (absl::ascii_isalpha(text[0]) ? refuse(one_of(type)) : true);
    if (!string(text)) return false;
    int number = 0;
    if (type.FindValueByName(text) != nullptr || absl::SimpleAtoi(text, &number)) return true;
    return refuse(one_of(type) + did_you_mean(text, enum_names(type)));
  }
  static std::string one_of(const EnumDescriptor& type) {
    return absl::StrCat("one of ", absl::StrJoin(enum_names(type), ", "));
  }

  bool unknown_field(const Descriptor& type, const std::string& key, std::size_t at, const std::string& path) {
    const std::vector<std::string> names = field_names(type);
    return meaning(at, path.empty() ? "the " + absl::AsciiStrToLower(type.name()) : path,
                   absl::StrCat(" has no field \"", key.substr(0, 60), "\"", did_you_mean(key, names), "; ",
                                names.empty() ? "it has no fields" : "expected one of " + absl::StrJoin(names, ", ")));
  }

  // Adds the node's name to its place, if it has one: "nodes[2] 'arm'.sphere". The whole node is read for this, since
  // the name may come after the misfit.
  std::string with_name(const std::string& path) const {
    const std::size_t end = path.find(']');
    if (end == std::string::npos || path.find('.') < end) return path;
    Walker node(text_);
    node.at_ = node_at_;
    std::string key, name;
    node.list('{', '}', [&] {
      if (!node.string(key) || !node.take(':')) return false;
      if (key == "name" && node.next_is('"')) return node.string(name) && false;
      return node.skip_value(0);
    });
    return name.empty() ? path : absl::StrCat(path.substr(0, end + 1), " '", name, "'", path.substr(end + 1));
  }

  const absl::string_view text_;
  std::size_t at_ = 0;
  std::size_t node_at_ = 0;  // where the last item of a list of the outermost message begins
  JsonMisfit misfit_;
};

}  // namespace

JsonMisfit find_misfit(absl::string_view text, const Descriptor& type) {
  return Walker(text).walk(type);
}

}  // namespace isofield
