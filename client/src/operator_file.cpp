#include "isofield/operator_file.h"

#include "isofield/scene_file.h"
#include "json_text.h"

namespace isofield {

absl::StatusOr<v1::Operator> read_operator_file(const std::string& path) {
  const auto data = read_file(path);
  if (!data.ok()) return data.status();
  v1::Operator message;
  if (auto status = parse_file(*data, path, "an operator", message); !status.ok()) return status;
  return message;
}

absl::StatusOr<std::string> format_operator_json(const v1::Operator& message) {
  auto text = format_json(message);
  if (text.ok()) text->push_back('\n');
  return text;
}

}  // namespace isofield
