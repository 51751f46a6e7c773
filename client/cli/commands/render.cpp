#include "render/render.h"

#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <memory>

#include "commands/mesh_flags.h"
#include "exit_codes.h"
#include "json_output.h"
#include "mesh_files/crease_normals.h"
#include "output_file.h"

namespace isofield {
namespace {

struct RenderArguments {
  MeshFlags flags;
  std::string output, size = "1280x960", view;
  std::optional<double> azimuth, elevation;
};

const std::map<std::string, View>& named_views() {
  static const auto* const kViews =
      new std::map<std::string, View>{{"front", {0, 0}}, {"back", {180, 0}},   {"right", {90, 0}}, {"left", {-90, 0}},
                                      {"top", {0, 90}},  {"bottom", {0, -90}}, {"corner", View()}};
  return *kViews;
}

absl::Status parse_size(const std::string& text, RenderOptions& options) {
  const std::size_t cross = text.find_first_of("xX");
  if (cross == std::string::npos || !absl::SimpleAtoi(text.substr(0, cross), &options.width) ||
      !absl::SimpleAtoi(text.substr(cross + 1), &options.height) || options.width < 16 || options.width > 8192 ||
      options.height < 16 || options.height > 8192) {
    return usage_error(absl::StrCat("--size \"", text, "\": expected WIDTHxHEIGHT, each within [16, 8192]"));
  }
  return absl::OkStatus();
}

absl::Status render_scene(const Context& context, const RenderArguments& arguments) {
  if (!absl::EndsWithIgnoreCase(arguments.output, ".png")) {
    return usage_error(absl::StrCat(arguments.output, ": not a picture that can be written; expected .png"));
  }
  RenderOptions options;
  if (auto status = parse_size(arguments.size, options); !status.ok()) return status;
  if (!arguments.view.empty()) options.view = named_views().at(arguments.view);
  options.view.azimuth = arguments.azimuth.value_or(options.view.azimuth);
  options.view.elevation = arguments.elevation.value_or(options.view.elevation);
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);

  double seconds = 0;
  const auto mesh = arguments.flags.request(context, seconds);
  if (!mesh.ok()) return mesh.status();
  const auto start = std::chrono::steady_clock::now();
  const auto image = render(split_at_creases(*mesh), options);
  if (!image.ok()) return image.status();
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_png(*image, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  const double render_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<std::string> warnings = mesh_warnings(mesh->summary, arguments.flags.cells_by());
  if (context.json) {
    JsonObject()
        .set("file", arguments.output)
        .set("request_seconds", seconds)
        .set("render_seconds", render_seconds)
        .set("summary", mesh->summary)
        .set("warnings", warnings)
        .print();
  } else {
    absl::PrintF("%s: %s%u triangles, cell %g; server %.3f s, request %.3f s, rendering %.3f s\n", arguments.output,
                 shells_clause(mesh->summary), mesh->triangle_count(), mesh->summary.cell_size(),
                 mesh->summary.seconds(), seconds, render_seconds);
    print_warnings(warnings);
  }
  return absl::OkStatus();
}

}  // namespace

void add_render_command(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Mesh the surface and draw a picture of it; y is up");
  arguments->flags.add_to(*command);
  command->add_option("-o,--output", arguments->output, "Picture to write (.png)")->required();
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  std::vector<std::string> names;
  for (const auto& view : named_views()) names.push_back(view.first);
  command->add_option("--view", arguments->view, "Where to look from (default: corner)")->check(CLI::IsMember(names));
  command->add_option("--azimuth", arguments->azimuth, "Degrees around y: 0 is the front, 90 the right side")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--elevation", arguments->elevation, "Degrees above the horizon")->check(CLI::Range(-90.0, 90.0));
  command->callback([&context, arguments] { context.outcome = render_scene(context, *arguments); });
}

}  // namespace isofield
