#include "points/python_literal.h"

#include <absl/strings/ascii.h>
#include <absl/strings/strip.h>

namespace isofield {
namespace {

using Kind = PythonLiteral::Kind;
constexpr int kMostDepth = 16;

class Parser {
 public:
  explicit Parser(absl::string_view text) : rest_(text) {}

  std::optional<PythonLiteral> parse() {
    PythonLiteral value;
    if (!parse_value(0, value)) return std::nullopt;
    skip_blanks();
    return rest_.empty() ? std::optional(std::move(value)) : std::nullopt;
  }

 private:
  void skip_blanks() { rest_ = absl::StripLeadingAsciiWhitespace(rest_); }

  bool take(char c) {
    skip_blanks();
    return absl::ConsumePrefix(&rest_, absl::string_view(&c, 1));
  }

  bool parse_value(int depth, PythonLiteral& value) {
    skip_blanks();
    if (rest_.empty() || depth > kMostDepth) return false;
    const char first = rest_.front();
    if (first == '\'' || first == '"') return parse_text(first, value);
    if (first == '(' || first == '[') {
      rest_.remove_prefix(1);
      value.kind = Kind::kList;
      return parse_items(first == '(' ? ')' : ']', depth, value);
    }
    if (first == '{') {
      rest_.remove_prefix(1);
      value.kind = Kind::kDictionary;
      return parse_items('}', depth, value);
    }
    std::size_t length = 0;
    while (length < rest_.size() &&
           (absl::ascii_isalnum(rest_[length]) || rest_[length] == '-' || rest_[length] == '_'))
      ++length;
    value.kind = absl::ascii_isdigit(first) || first == '-' ? Kind::kNumber : Kind::kName;
    value.text = std::string(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return length > 0;
  }

  bool parse_text(char quote, PythonLiteral& value) {
    value.kind = Kind::kText;
    std::size_t at = 1;
    for (; at < rest_.size() && rest_[at] != quote; ++at) {
      if (rest_[at] == '\\') ++at;
      if (at < rest_.size()) value.text.push_back(rest_[at]);
    }
    if (at >= rest_.size()) return false;
    rest_.remove_prefix(at + 1);
    return true;
  }

  bool parse_items(char close, int depth, PythonLiteral& value) {
    while (!take(close)) {
      if (!parse_value(depth + 1, value.items.emplace_back())) return false;
      if (value.kind == Kind::kDictionary && (!take(':') || !parse_value(depth + 1, value.items.emplace_back())))
        return false;
      if (take(close)) return true;
      if (!take(',')) return false;
    }
    return true;
  }

  absl::string_view rest_;
};

}  // namespace

const PythonLiteral* PythonLiteral::find(absl::string_view key) const {
  for (std::size_t i = 0; kind == Kind::kDictionary && i + 1 < items.size(); i += 2) {
    if (items[i].text == key) return &items[i + 1];
  }
  return nullptr;
}

std::optional<PythonLiteral> parse_python_literal(absl::string_view text) {
  return Parser(text).parse();
}

}  // namespace isofield
