#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <memory>

#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "isofield/scene_file.h"
#include "json_output.h"
#include "output_ending.h"
#include "output_file.h"

namespace isofield {
namespace {

absl::Status import(const Context& context, const std::string& path, const std::string& output,
                    const ImportFlags& flags) {
  if (auto status = check_output_ending(output, {".json", ".pb"}); !status.ok()) return status;
  if (auto status = OutputFile::check(output); !status.ok()) return file_error(status);
  const auto loaded = load_scene(path, flags.get());
  if (!loaded.ok()) return loaded.status();
  absl::StatusOr<std::string> text;
  if (absl::EndsWithIgnoreCase(output, ".pb")) {
    text = loaded->scene.SerializeAsString();
  } else {
    text = format_scene_json(loaded->scene);
  }
  if (!text.ok()) return text.status();
  auto file = OutputFile::create(output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = (*file)->write(*text);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json && output != "-") {
    JsonObject written;
    written.set("file", output);
    if (loaded->report) written.set("report", to_json(*loaded->report));
    written.print();
  }
  return absl::OkStatus();
}

}  // namespace

void add_import_command(Command app, Context& context) {
  struct Arguments {
    std::string file, output = "-";
    ImportFlags flags;
  };
  const auto arguments = std::make_shared<Arguments>();
  Command command = app.add_subcommand("import", "Make a scene of a neuron, a molecule or points; needs no server");
  command
      .add_option("FILE", arguments->file,
                  "Neuron (.swc), molecule (.pdb, .cif, .xyz) or points, one \"x y z\" a line (.xyz, .txt, .csv); "
                  "also packed (.gz)")
      .required();
  command.add_option("-o,--output", arguments->output, "Scene to write (.json, .pb); - is the standard output")
      .shows_default();
  arguments->flags.add_to(command);
  command.callback([&context, arguments] {
    context.outcome = import(context, arguments->file, arguments->output, arguments->flags);
  });
}

}  // namespace isofield
