#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <memory>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "output_ending.h"
#include "plot/plot_file.h"
#include "plot/slice_plot.h"
#include "points/npy_header.h"
#include "points/table.h"

namespace isofield {
namespace {

struct SliceArguments {
  std::string scene, output;
  std::vector<double> origin, u, v, spacing, levels;
  std::vector<std::uint64_t> counts;
  int size = 800;
  ImportFlags flags;
};

absl::StatusOr<Slice> request_slice(const Context& context, const SliceArguments& arguments) {
  const auto scene = scene_argument(arguments.scene, arguments.flags.get());
  if (!scene.ok()) return scene.status();
  v1::SliceRequest request;
  *request.mutable_scene() = *scene;
  request.mutable_origin()->Assign(arguments.origin.begin(), arguments.origin.end());
  request.mutable_u()->Assign(arguments.u.begin(), arguments.u.end());
  request.mutable_v()->Assign(arguments.v.begin(), arguments.v.end());
  request.mutable_spacing()->Assign(arguments.spacing.begin(), arguments.spacing.end());
  request.mutable_counts()->Assign(arguments.counts.begin(), arguments.counts.end());
  request.mutable_levels()->Assign(arguments.levels.begin(), arguments.levels.end());
  auto client = context.connect();
  if (!client.ok()) return client.status();
  return client->slice(request);
}

absl::Status write_slice(const Slice& slice, const SliceArguments& arguments, OutputFile& file) {
  const std::array<double, 2>& spacing = slice.spacing;
  if (const auto format = plot_format(arguments.output)) {
    return write_plot(draw(slice, spacing, stem(arguments.scene), arguments.size), *format, file);
  }
  if (absl::EndsWithIgnoreCase(arguments.output, ".npy")) {
    absl::Status status = file.write(npy_header(slice.counts[1], slice.counts[0]));
    if (status.ok()) status = file.write(slice.values.data(), 4 * slice.values.size());
    return status;
  }
  std::vector<double> along_u, along_v;
  for (std::size_t n = 0; n < slice.values.size(); ++n) {
    const std::uint64_t column = n % slice.counts[0], row = n / slice.counts[0];
    along_u.push_back(spacing[0] * static_cast<double>(column));
    along_v.push_back(spacing[1] * static_cast<double>(row));
  }
  Table table;
  table.add("u", std::span<const double>(along_u));
  table.add("v", std::span<const double>(along_v));
  table.add("value", std::span<const float>(slice.values));
  return table.write(arguments.output, file);
}

absl::Status slice_scene(const Context& context, const SliceArguments& arguments) {
  if (arguments.output == "-" && context.json) {
    return usage_error("--json and results on the standard output do not go together; state -o FILE");
  }
  if (auto status = check_output_ending(arguments.output, {".png", ".svg", ".pdf", ".csv", ".npy", ".json"});
      !status.ok()) {
    return status;
  }
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);
  const auto slice = request_slice(context, arguments);
  if (!slice.ok()) return slice.status();
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_slice(*slice, arguments, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json) {
    const auto list = [](const auto& numbers) { return std::vector<double>(numbers.begin(), numbers.end()); };
    JsonObject()
        .set("file", arguments.output)
        .set("points", slice->values.size())
        .set("origin", list(slice->origin))
        .set("u", list(slice->u))
        .set("v", list(slice->v))
        .set("spacing", list(slice->spacing))
        .set("counts", list(slice->counts))
        .print();
  }
  return absl::OkStatus();
}

}  // namespace

void add_slice_command(Command app, Context& context) {
  const auto arguments = std::make_shared<SliceArguments>();
  Command command = app.add_subcommand(
      "slice",
      "Evaluate the field on a part of a plane, and draw it. By default that is the plane of normal z through the "
      "middle of the box that holds the field's support, over the whole box");
  command.add_option("SCENE", arguments->scene, "A file, or else a name on the server").required();
  command
      .add_option("--origin", arguments->origin,
                  "x,y,z in model units: the first sample, lower left in a picture (default: so that the middle of "
                  "the samples is the middle of the box)")
      .check(number())
      .delimiter(',')
      .expected(3);
  command.add_option("--u", arguments->u, "x,y,z: the direction to the right in a picture (default: 1,0,0)")
      .check(number())
      .delimiter(',')
      .expected(3);
  command.add_option("--v", arguments->v, "x,y,z: the direction upwards (default: 0,1,0); made at right angles to u")
      .check(number())
      .delimiter(',')
      .expected(3);
  command
      .add_option("--spacing", arguments->spacing,
                  "Model units between samples, for both axes or each (default: so that the samples span the box)")
      .check(positive())
      .delimiter(',')
      .expected(1, 2);
  command
      .add_option("--counts", arguments->counts,
                  "Samples along u,v (default: as many as span the box; without --spacing 512 along the longer axis)")
      .check(whole(1, std::uint64_t{1} << 32))
      .delimiter(',')
      .expected(2);
  command
      .add_option("--levels", arguments->levels,
                  "Field values whose level curves a picture shows, the first one as a thick line (default: the "
                  "surface's)")
      .check(number())
      .delimiter(',');
  command
      .add_option(
          "-o,--output", arguments->output,
          "Picture (.png, .svg, .pdf), NumPy array (counts[1], counts[0]) (.npy), or u,v,value as text (.csv) or an "
          "object of arrays (.json), u and v from the first sample; - is text on the standard output")
      .required();
  command.add_option("--size", arguments->size, "Pixels of a picture's longer side; in .svg and .pdf 96 are an inch")
      .check(whole(64, 8192))
      .shows_default();
  arguments->flags.add_to(command);
  command.callback([&context, arguments] { context.outcome = slice_scene(context, *arguments); });
}

}  // namespace isofield
