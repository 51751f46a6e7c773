#include "points/table.h"

#include <absl/strings/match.h>

#include <charconv>
#include <cmath>

#include "points/npy_header.h"

namespace isofield {
namespace {

void append_number(float value, std::string& text) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::general, 9).ptr);
}

// Appends a cell. If it has a comma, a quote or the end of a line in it, it is put in double quotes, and quotes in it
// are doubled (RFC 4180).
void append_cell(const std::string& value, std::string& text) {
  if (value.find_first_of(",\"\n\r") == std::string::npos) {
    text += value;
    return;
  }
  text.push_back('"');
  for (const char c : value) text.append(c == '"' ? 2 : 1, c);
  text.push_back('"');
}

void append_json(const std::string& value, std::string& text) {
  static constexpr char kDigits[] = "0123456789abcdef";
  text.push_back('"');
  for (const char c : value) {
    if (c == '"' || c == '\\') text.push_back('\\');
    if (static_cast<unsigned char>(c) < 0x20) {
      text += "\\u00";
      text.push_back(kDigits[c >> 4]);
      text.push_back(kDigits[c & 15]);
    } else {
      text.push_back(c);
    }
  }
  text.push_back('"');
}

}  // namespace

absl::Status Table::write(const std::string& path, OutputFile& file) const {
  if (absl::EndsWithIgnoreCase(path, ".npy")) return write_npy(file);
  if (absl::EndsWithIgnoreCase(path, ".json")) return write_json(file);
  return write_csv(file);
}

absl::Status Table::write_csv(OutputFile& file) const {
  std::string text;
  for (const Column& c : columns_) text += c.name + (&c == &columns_.back() ? "\n" : ",");
  for (std::size_t row = 0; row < rows(); ++row) {
    for (const Column& c : columns_) {
      c.holds_texts ? append_cell(c.texts[row], text) : append_number(c.numbers[row], text);
      text.push_back(&c == &columns_.back() ? '\n' : ',');
    }
    if (auto status = file.write(text); !status.ok()) return status;
    text.clear();
  }
  return file.write(text);
}

absl::Status Table::write_npy(OutputFile& file) const {
  std::vector<const Column*> numbers;
  for (const Column& c : columns_) {
    if (!c.holds_texts) numbers.push_back(&c);
  }
  std::vector<std::string> names;
  for (const Column* c : numbers) names.push_back(c->name);
  absl::Status status = file.write(npy_header(rows(), names));
  std::vector<float> line(numbers.size());
  for (std::size_t row = 0; row < rows() && status.ok(); ++row) {
    for (std::size_t n = 0; n < numbers.size(); ++n) line[n] = numbers[n]->numbers[row];
    status = file.write(line.data(), 4 * line.size());
  }
  return status;
}

absl::Status Table::write_json(OutputFile& file) const {
  std::string text = "{";
  for (const Column& c : columns_) {
    append_json(c.name, text);
    text += ": [";
    for (std::size_t row = 0; row < rows(); ++row) {
      if (row > 0) text += ", ";
      if (c.holds_texts) {
        append_json(c.texts[row], text);
      } else if (std::isfinite(c.numbers[row])) {
        append_number(c.numbers[row], text);
      } else {
        text += "null";
      }
    }
    text += &c == &columns_.back() ? "]" : "],\n ";
  }
  return file.write(text + "}\n");
}

}  // namespace isofield
