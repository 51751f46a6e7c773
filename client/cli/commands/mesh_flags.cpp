#include "commands/mesh_flags.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <chrono>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/scene_argument.h"
#include "progress_line.h"

namespace isofield {

void MeshFlags::add_to(Command command) {
  command.add_option("SCENE", scene, "A file, or else a name on the server").required();
  Option cell_option =
      command
          .add_option("--cell", cell,
                      "Edge length of a cell, in model units (default: chosen by the server after the thinnest part)")
          .check(positive());
  command.add_option("--resolution", resolution, "Cells along the longest edge of the bounds")
      .check(whole(1, 1048576))
      .excludes(cell_option);
  command
      .add_option("--bounds", bounds, "x0,y0,z0,x1,y1,z1: the box to mesh, in model units (default: all of the scene)")
      .check(number())
      .delimiter(',')
      .expected(6);
  command
      .add_option("--iso", iso,
                  "Iso value of the surface: within ]0, 1[ of a positive field (default: 0.5), any of a signed one "
                  "(default: 0)")
      .check(number());
  command
      .add_option("--tolerance", tolerance,
                  "Distance at which a vertex counts as on the surface, in cells, within [1e-5, 0.1] (default: 1e-3)")
      .check(within(1e-5, 0.1));
  command
      .add_option("--simplify", simplify,
                  "Use fewer triangles, within this distance of the full mesh, in model units (default: use all)")
      .check(positive());
  command.add_flag("--largest", largest_body, "Keep only the body that encloses the largest volume, with its voids");
  command.add_flag("--fill-voids", fill_voids, "Leave out voids, and bodies that float inside them");
  import.add_to(command);
}

absl::StatusOr<v1::MeshRequest> MeshFlags::message() const {
  v1::MeshRequest request;
  auto reference = scene_argument(scene, import.get());
  if (!reference.ok()) return reference.status();
  *request.mutable_scene() = *std::move(reference);
  if (cell) {
    request.set_cell_size(*cell);
  } else if (resolution) {
    request.set_resolution(*resolution);
  }
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    (i < 3 ? request.mutable_bounds_min() : request.mutable_bounds_max())->Add(bounds[i]);
  }
  if (iso) request.set_iso(*iso);
  if (tolerance) request.set_tolerance(*tolerance);
  if (simplify) request.set_simplification_error(*simplify);
  request.set_omit_normals(omit_normals);
  request.set_crease_normals(crease_normals && !omit_normals);
  request.set_largest_body(largest_body);
  request.set_fill_voids(fill_voids);
  return request;
}

absl::StatusOr<Mesh> MeshFlags::request(const Context& context, Client& client, double& seconds) const {
  const auto request = message();
  if (!request.ok()) return request.status();
  ProgressLine progress(!context.json);
  const auto start = std::chrono::steady_clock::now();
  auto mesh = client.mesh(*request, [&](const v1::MeshProgress& at) {
    const char* const stage = at.stage() == v1::MeshProgress::COMPILING_KERNELS ? "compiling kernels" : "meshing";
    progress.show(stage, absl::StrFormat("%3.0f %%", 100 * at.fraction()));
    return true;
  });
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!mesh.ok()) return explain(mesh.status());
  return mesh;
}

absl::Status MeshFlags::explain(const absl::Status& refusal) const {
  const absl::string_view message = refusal.message();
  const char* flag = nullptr;
  if (bounds.empty() && absl::IsInvalidArgument(refusal) && absl::StrContains(message, "bounds")) flag = "--bounds";
  if (absl::StartsWith(message, "cell_size")) flag = "--cell";
  if (absl::StartsWith(message, "resolution")) flag = "--resolution";
  return flag == nullptr ? refusal : absl::Status(refusal.code(), absl::StrCat(message, " (", flag, ")"));
}

CellsBy MeshFlags::cells_by() const {
  if (cell) return CellsBy::kCell;
  return resolution ? CellsBy::kResolution : CellsBy::kServer;
}

}  // namespace isofield
