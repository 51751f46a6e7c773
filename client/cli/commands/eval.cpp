#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <memory>

#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/point_table.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "output_ending.h"
#include "output_file.h"
#include "points/point_reader.h"
#include "points/result_writer.h"
#include "progress_line.h"

namespace isofield {
namespace {

struct EvalArguments {
  std::string scene, points, output = "-";
  bool gradient = false, shared_memory = false;
  ImportFlags flags;
};

absl::Status evaluate(const Context& context, const EvalArguments& arguments) {
  if (arguments.output == "-" && context.json) {
    return usage_error("--json and results on the standard output do not go together; state -o FILE");
  }
  if (auto status = check_output_ending(arguments.output, {".csv", ".npy"}); !status.ok()) return status;
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);
  const auto scene = scene_argument(arguments.scene, arguments.flags.get());
  if (!scene.ok()) return scene.status();
  auto reader = open_points(arguments.points);
  if (!reader.ok()) return file_error(reader.status());
  auto client = context.connect(arguments.shared_memory);
  if (!client.ok()) return client.status();
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  const auto writer = make_result_writer(arguments.output, arguments.gradient, **file);

  std::uint64_t points = 0;
  absl::Status status;
  {
    ProgressLine progress(!context.json && arguments.output != "-");
    status = client->evaluate(
        *scene, arguments.gradient,
        [&](std::vector<float>& xyz) {
          auto read = (*reader)->read(Client::kChunkPoints, xyz);
          return read.ok() ? read : file_error(read);
        },
        [&](std::span<const float> xyz, std::span<const float> results) {
          points += xyz.size() / 3;
          progress.show("evaluated", absl::StrCat(points, " points"));
          auto written = writer->write(xyz, results);
          return written.ok() ? written : file_error(written);
        });
  }
  if (!status.ok()) return status;
  print_notes(context, (*reader)->notes());
  status = writer->finish();
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json) {
    JsonObject().set("file", arguments.output).set("points", points).set("notes", (*reader)->notes()).print();
  }
  return absl::OkStatus();
}

}  // namespace

void add_eval_command(Command app, Context& context) {
  const auto arguments = std::make_shared<EvalArguments>();
  Command command = app.add_subcommand("eval", "Evaluate the field, and its gradient, at points");
  command.add_option("SCENE", arguments->scene, "A file, or else a name on the server").required();
  command.add_option("--points", arguments->points, kPointsHelp).required();
  command.add_flag("--gradient", arguments->gradient, "Evaluate the gradient too");
  command.add_flag("--shared-memory", arguments->shared_memory,
                   "Pass points and results through memory shared with the server, if the server offers that");
  command
      .add_option("-o,--output", arguments->output,
                  "Text x,y,z,value[,gx,gy,gz] (.csv), or a NumPy array (n, 1 or 4) (.npy); - is the standard output")
      .shows_default();
  arguments->flags.add_to(command);
  command.callback([&context, arguments] { context.outcome = evaluate(context, *arguments); });
}

}  // namespace isofield
