#include "points/npy_header.h"

#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include "excerpt.h"
#include "points/python_literal.h"

namespace isofield {
namespace {

using Kind = PythonLiteral::Kind;
constexpr std::size_t kMostItemBytes = 1 << 16;
constexpr std::size_t kMostFields = 4096;

absl::Status refuse_type(absl::string_view type) {
  return absl::InvalidArgumentError(
      absl::StrCat("dtype ", excerpt(type),
                   "; expected numbers, such as '<f4' or '<f8' (float32, float64), '<i4', "
                   "or a structured type with fields x, y and z"));
}

// Reads a plain type, such as "<f4". A type that is no number, such as text, has a size, but number.bytes becomes 0.
absl::Status parse_type(absl::string_view type, NpyNumber& number, std::size_t& bytes) {
  absl::string_view rest = type;
  const char order = rest.empty() ? '\0' : rest.front();
  if (order == '<' || order == '>' || order == '|' || order == '=') rest.remove_prefix(1);
  if (rest.empty()) return refuse_type(type);
  const char kind = rest.front();
  // A unit may follow the size, as in "M8[ns]".
  rest = rest.substr(1, rest.find('[') == absl::string_view::npos ? rest.npos : rest.find('[') - 1);
  std::uint32_t size = 0;
  if (kind == '?') size = 1;
  if (kind == 'O' || (kind != '?' && (!absl::SimpleAtoi(rest, &size) || size > kMostItemBytes)))
    return refuse_type(type);
  bytes = kind == 'U' ? 4 * std::size_t{size} : size;
  const bool is_float = kind == 'f' && (size == 2 || size == 4 || size == 8);
  const bool is_integer = (kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8);
  number = {kind, is_float || is_integer ? bytes : 0, order == '>'};
  return absl::OkStatus();
}

// Returns the number of elements in a field's shape, which is written as 3 or (3,). Nothing: the shape cannot be read,
// or it is 0 or too large.
std::optional<std::size_t> count_of(const PythonLiteral& shape) {
  std::size_t count = 1;
  const auto multiply = [&](const PythonLiteral& factor) {
    std::uint32_t number = 0;
    if (factor.kind != Kind::kNumber || !absl::SimpleAtoi(factor.text, &number) || number > kMostItemBytes)
      return false;
    // Fields without elements are refused. They have no size, so the limit on a type's size would not limit their
    // number.
    if (number == 0) return false;
    count *= number;
    return count <= kMostItemBytes;
  };
  if (shape.kind == Kind::kNumber) return multiply(shape) ? std::optional(count) : std::nullopt;
  if (shape.kind != Kind::kList) return std::nullopt;
  for (const PythonLiteral& factor : shape.items) {
    if (!multiply(factor)) return std::nullopt;
  }
  return count;
}

// Adds the fields of a type at an offset, and sets `bytes` to the size of the type. The name of a nested field follows
// that of the outer one.
absl::Status add_fields(const PythonLiteral& type, const std::string& name, std::size_t offset, NpyHeader& header,
                        std::size_t& bytes) {
  if (type.kind == Kind::kText) {
    NpyField& field = header.fields.emplace_back(NpyField{name, offset, {}});
    if (header.fields.size() > kMostFields)
      return absl::InvalidArgumentError("a structured type of more than 4096 fields");
    return parse_type(type.text, field.number, bytes);
  }
  if (type.kind != Kind::kList || type.items.empty())
    return absl::InvalidArgumentError("the header is damaged: no dtype can be read from it");
  bytes = 0;
  for (const PythonLiteral& part : type.items) {
    if (part.kind != Kind::kList || part.items.size() < 2 || part.items.size() > 3) {
      return absl::InvalidArgumentError("the header is damaged: no structured type can be read from it");
    }
    // A name may be a pair: (title, name).
    const PythonLiteral& label = part.items[0];
    const std::string& own = label.kind == Kind::kList && label.items.size() == 2 ? label.items[1].text : label.text;
    const std::string full = name.empty() ? own : absl::StrCat(name, " ", own);
    const auto count = part.items.size() == 3 ? count_of(part.items[2]) : std::optional<std::size_t>(1);
    if (!count) return absl::InvalidArgumentError("the header is damaged: a field's shape cannot be read");
    const bool is_vector = part.items.size() == 3 && *count == 3;
    for (std::size_t i = 0; i < *count; ++i) {
      std::size_t part_bytes = 0;
      const std::string numbered = is_vector ? absl::StrCat(full, " ", std::string(1, "xyz"[i])) : full;
      if (auto status = add_fields(part.items[1], numbered, offset + bytes, header, part_bytes); !status.ok()) {
        return status;
      }
      bytes += part_bytes;
      if (bytes > kMostItemBytes) return absl::InvalidArgumentError("a structured type of more than 65536 bytes");
    }
  }
  return absl::OkStatus();
}

// Returns a NumPy header of `bytes` bytes: the magic bytes, the version, the length, and the padded description.
std::string with_magic(std::string description, std::size_t bytes) {
  description.resize(bytes - 11, ' ');
  description.push_back('\n');
  std::string text("\x93NUMPY\x01\x00", 8);
  text.push_back(static_cast<char>(description.size() & 255));
  text.push_back(static_cast<char>(description.size() >> 8));
  return text + description;
}

}  // namespace

absl::StatusOr<NpyHeader> parse_npy_header(absl::string_view dictionary) {
  const auto literal = parse_python_literal(dictionary);
  const PythonLiteral* const type = literal ? literal->find("descr") : nullptr;
  const PythonLiteral* const order = literal ? literal->find("fortran_order") : nullptr;
  const PythonLiteral* const shape = literal ? literal->find("shape") : nullptr;
  if (!type || !order || !shape || shape->kind != Kind::kList || (order->text != "True" && order->text != "False")) {
    return absl::InvalidArgumentError("the header is damaged: expected 'descr', 'fortran_order' and 'shape'");
  }
  NpyHeader header;
  header.fortran_order = order->text == "True";
  for (const PythonLiteral& length : shape->items) {
    // Files of Python 2 have lengths such as "3L".
    const absl::string_view digits = absl::string_view(length.text).substr(0, length.text.find('L'));
    if (length.kind != Kind::kNumber || !absl::SimpleAtoi(digits, &header.shape.emplace_back())) {
      return absl::InvalidArgumentError(
          absl::StrCat("the header is damaged: the shape has the length ", excerpt(length.text)));
    }
  }
  if (auto status = add_fields(*type, "", 0, header, header.item_bytes); !status.ok()) return status;
  if (!header.is_structured() && header.fields[0].number.bytes == 0) return refuse_type(type->text);
  return header;
}

std::string npy_header(std::uint64_t rows, std::uint64_t columns) {
  // The format asks for a length that is a multiple of 64.
  return with_magic(absl::StrCat("{'descr': '<f4', 'fortran_order': False, 'shape': (", rows, ", ", columns, "), }"),
                    128);
}

std::string npy_header(std::uint64_t rows, const std::vector<std::string>& names) {
  std::string fields;
  for (const std::string& name : names) absl::StrAppend(&fields, fields.empty() ? "" : ", ", "('", name, "', '<f4')");
  const std::string description =
      absl::StrCat("{'descr': [", fields, "], 'fortran_order': False, 'shape': (", rows, ",), }");
  return with_magic(description, (description.size() + 11 + 63) / 64 * 64);
}

}  // namespace isofield
