#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>

#include "commands/mesh_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "mesh_files/mesh_file.h"

namespace isofield {
namespace {

absl::Status mesh(const Context& context, const MeshFlags& flags, const std::string& output, CreaseShading shading) {
  const auto format = mesh_format(output);
  if (!format) {
    return usage_error(
        absl::StrCat(output, ": not a mesh format that can be written; expected .glb, .obj, .ply or .stl"));
  }
  if (auto status = OutputFile::check(output); !status.ok()) return file_error(status);
  double seconds = 0;
  const auto mesh = flags.request(context, seconds);
  if (!mesh.ok()) return mesh.status();
  const auto start = std::chrono::steady_clock::now();
  auto file = OutputFile::create(output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_mesh(*mesh, *format, stem(flags.scene), **file, shading);
  const std::uint64_t bytes = (*file)->bytes();
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<std::string> warnings = mesh_warnings(mesh->summary, flags.cells_by());
  if (context.json) {
    JsonObject()
        .set("file", output)
        .set("bytes", static_cast<double>(bytes))
        .set("request_seconds", seconds)
        .set("write_seconds", write_seconds)
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

void add_mesh_command(CLI::App& app, Context& context) {
  struct Arguments {
    MeshFlags flags;
    std::string output;
    bool smooth_creases = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("mesh", "Mesh the surface into a file");
  arguments->flags.add_to(*command);
  command->add_option("-o,--output", arguments->output, "Mesh to write (.glb, .obj, .ply, .stl)")->required();
  command->add_flag("--no-normals", arguments->flags.omit_normals, "Leave the normals out");
  command->add_flag("--smooth-creases", arguments->smooth_creases,
                    "One normal a vertex, on creases too (default: one for each side, in .glb and .obj)");
  command->callback([&context, arguments] {
    context.outcome = mesh(context, arguments->flags, arguments->output,
                           arguments->smooth_creases ? CreaseShading::kSmooth : CreaseShading::kSharp);
  });
}

}  // namespace isofield
