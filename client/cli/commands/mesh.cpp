#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <chrono>
#include <memory>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/mesh_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "isofield/unit.h"
#include "json_output.h"
#include "mesh_files/mesh_file.h"

namespace isofield {
namespace {

struct Arguments {
  MeshFlags flags;
  std::string output, units;
  std::optional<double> scale;
  bool smooth_creases = false;
};

// These limits keep coordinates of 1e-9 to 1e9 model units well within float32.
constexpr double kLeastScale = 1e-18, kMostScale = 1e18;

// Chooses the unit of the file's coordinates. A GLB is in metres if the scene's unit is known; other files stay in
// model units unless the options say otherwise. It adds a note to `warnings` if it does not understand the scene's
// unit.
absl::StatusOr<FileUnit> file_unit(const Arguments& arguments, MeshFormat format, const std::string& scene_unit,
                                   std::vector<std::string>& warnings) {
  if (arguments.scale) {
    if (scene_unit.empty()) return FileUnit{*arguments.scale, ""};
    return FileUnit{*arguments.scale, absl::StrCat(scene_unit, ", coordinates times ", *arguments.scale)};
  }
  const std::optional<double> from = unit_in_metres(scene_unit);
  if (!arguments.units.empty()) {
    // Most quotients of units are short decimal numbers. Binary division misses them by a rounding, which this undoes.
    if (from)
      return FileUnit{std::stod(absl::StrFormat("%.12g", *from / *unit_in_metres(arguments.units))), arguments.units};
    return usage_error(absl::StrCat(
        "--units ", arguments.units, ": the scene's unit is \"", scene_unit, "\", expected ", kUnitNames,
        ", which its field `unit` states, or --unit where a file is imported; --scale states a factor instead"));
  }
  if (format != MeshFormat::kGlb) return FileUnit{1, scene_unit};
  if (!from && !scene_unit.empty()) {
    warnings.push_back(absl::StrCat("the scene's unit is \"", scene_unit, "\", expected ", kUnitNames,
                                    "; the GLB's coordinates, which readers take for metres, are in model units "
                                    "(--scale states a factor)"));
  }
  return FileUnit{from.value_or(1), "m"};
}

absl::Status mesh(const Context& context, const Arguments& arguments) {
  MeshFlags flags = arguments.flags;
  const std::string& output = arguments.output;
  const CreaseShading shading = arguments.smooth_creases ? CreaseShading::kSmooth : CreaseShading::kSharp;
  const auto format = mesh_format(output);
  if (!format) {
    return usage_error(
        absl::StrCat(output, ": not a mesh format that can be written; expected .glb, .obj, .ply or .stl"));
  }
  if (!arguments.units.empty() && !unit_in_metres(arguments.units)) {
    return usage_error(absl::StrCat("--units ", arguments.units, ": expected ", kUnitNames));
  }
  if (auto status = OutputFile::check(output); !status.ok()) return file_error(status);
  flags.crease_normals = shading == CreaseShading::kSharp && names_creases(*format);
  auto client = context.connect();
  if (!client.ok()) return client.status();
  double seconds = 0;
  const auto mesh = flags.request(context, *client, seconds);
  if (!mesh.ok()) return mesh.status();
  std::vector<std::string> warnings = mesh_warnings(mesh->summary, flags.cells_by());
  const auto unit = file_unit(arguments, *format, mesh->summary.unit(), warnings);
  if (!unit.ok()) return unit.status();
  if (!(unit->scale >= kLeastScale && unit->scale <= kMostScale)) {
    return usage_error(absl::StrCat("coordinates times ", unit->scale,
                                    " (--scale, --units): expected a factor within [", kLeastScale, ", ", kMostScale,
                                    "]"));
  }
  const auto start = std::chrono::steady_clock::now();
  auto file = OutputFile::create(output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_mesh(*mesh, *format, stem(flags.scene), **file, shading, *unit);
  const std::uint64_t bytes = (*file)->bytes();
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (context.json) {
    JsonObject()
        .set("file", output)
        .set("bytes", bytes)
        .set("request_seconds", seconds)
        .set("write_seconds", write_seconds)
        .set("scale", unit->scale)
        .set("summary", mesh->summary)
        .set("warnings", warnings)
        .print();
  } else {
    absl::PrintF("%s: %s%u vertices, %u triangles, cell %g; server %.3f s, request %.3f s, writing %.3f s\n", output,
                 shells_clause(mesh->summary), mesh->vertex_count(), mesh->triangle_count(), mesh->summary.cell_size(),
                 mesh->summary.seconds(), seconds, write_seconds);
    print_warnings(warnings);
  }
  return absl::OkStatus();
}

}  // namespace

void add_mesh_command(Command app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  Command command = app.add_subcommand("mesh", "Mesh the surface into a file");
  arguments->flags.add_to(command);
  command.add_option("-o,--output", arguments->output, "Mesh to write (.glb, .obj, .ply, .stl)").required();
  command.add_flag("--no-normals", arguments->flags.omit_normals, "Leave the normals out");
  command.add_flag("--smooth-creases", arguments->smooth_creases,
                   "One normal a vertex, on creases too (default: one for each side, in .glb and .obj)");
  const Option units = command.add_option(
      "--units", arguments->units,
      "Unit of the file's coordinates, such as mm or \"8 nm\" (default: the scene's own; .glb: metres)");
  command
      .add_option("--scale", arguments->scale,
                  "Factor from model units to the file's coordinates, whatever the scene's unit (default: 1; .glb: "
                  "metres in the scene's unit)")
      .check(positive())
      .excludes(units);
  command.callback([&context, arguments] { context.outcome = mesh(context, *arguments); });
}

}  // namespace isofield
