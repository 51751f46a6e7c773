#pragma once

#include <absl/status/statusor.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "points/table.h"
#include "points/vector_columns.h"

namespace isofield {

// The arguments of the commands that ask the server a question about many points and write a table of answers.
struct PointTableArguments {
  std::string scene, points, output = "-";
  std::optional<double> iso;
  ImportFlags flags;

  // `points_name` is the option that names the file of points.
  void add_to(Command command, const std::string& points_name);
};

// Reads all points of a file, [n, 3], and adds the reader's notes to `notes`.
absl::StatusOr<std::vector<float>> read_points(const std::string& path, std::vector<std::string>& notes,
                                               const VectorColumns& wanted = {});

// Prints notes on the standard error; with --json nothing, since they are a part of the object there.
void print_notes(const Context& context, const std::vector<std::string>& notes);

// Reads the points, asks the server and writes the answers. `ask` fills the table from the answers, and may add notes.
using AskPoints = std::function<absl::Status(Client& client, const v1::SceneRef& scene, std::span<const float> xyz,
                                             Table& table, std::vector<std::string>& notes)>;
absl::Status answer_points(const Context& context, const PointTableArguments& arguments, const AskPoints& ask,
                           const VectorColumns& wanted = {});

}  // namespace isofield
