#include "commands/point_table.h"

#include <cstdio>

#include "commands/checks.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "output_ending.h"
#include "points/point_reader.h"

namespace isofield {

void PointTableArguments::add_to(Command command, const std::string& points_name) {
  command.add_option("SCENE", scene, "A file, or else a name on the server").required();
  command.add_option(points_name, points, kPointsHelp).required();
  command
      .add_option("--iso", iso,
                  "Iso value of the surface: within ]0, 1[ of a positive field (default: 0.5), any of a signed one "
                  "(default: 0)")
      .check(number());
  command
      .add_option("-o,--output", output,
                  "Text with a header (.csv), a NumPy structured array with a field for each column of numbers (.npy), "
                  "or an object of arrays (.json); - is the standard output")
      .shows_default();
  flags.add_to(command);
}

absl::StatusOr<std::vector<float>> read_points(const std::string& path, std::vector<std::string>& notes,
                                               const VectorColumns& wanted) {
  auto reader = open_points(path, wanted);
  if (!reader.ok()) return file_error(reader.status());
  std::vector<float> xyz;
  for (std::size_t before = 1; xyz.size() != before;) {
    before = xyz.size();
    if (auto status = (*reader)->read(Client::kChunkPoints, xyz); !status.ok()) return file_error(status);
  }
  for (std::string& note : (*reader)->notes()) notes.push_back(std::move(note));
  return xyz;
}

void print_notes(const Context& context, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (!context.json) std::fprintf(stderr, "note: %s\n", note.c_str());
  }
}

absl::Status answer_points(const Context& context, const PointTableArguments& arguments, const AskPoints& ask,
                           const VectorColumns& wanted) {
  if (arguments.output == "-" && context.json) {
    return usage_error("--json and results on the standard output do not go together; state -o FILE");
  }
  if (auto status = check_output_ending(arguments.output, {".csv", ".npy", ".json"}); !status.ok()) return status;
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);
  const auto scene = scene_argument(arguments.scene, arguments.flags.get());
  if (!scene.ok()) return scene.status();
  std::vector<std::string> notes;
  const auto xyz = read_points(arguments.points, notes, wanted);
  if (!xyz.ok()) return xyz.status();
  auto client = context.connect();
  if (!client.ok()) return client.status();
  Table table;
  if (auto status = ask(*client, *scene, *xyz, table, notes); !status.ok()) return status;
  print_notes(context, notes);
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = table.write(arguments.output, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json) {
    JsonObject().set("file", arguments.output).set("rows", table.rows()).set("notes", notes).print();
  }
  return absl::OkStatus();
}

}  // namespace isofield
