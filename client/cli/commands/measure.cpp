#include <absl/strings/str_format.h>

#include <memory>

#include "commands/command_line.h"
#include "commands/mesh_flags.h"
#include "json_output.h"

namespace isofield {
namespace {

absl::Status measure(const Context& context, const MeshFlags& flags) {
  const auto request = flags.message();
  if (!request.ok()) return request.status();
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto m = client->measure(*request);
  if (!m.ok()) return flags.explain(m.status());
  const std::vector<std::string> warnings = mesh_warnings(m->summary(), flags.cells_by());
  if (context.json) {
    JsonObject(*m).set("warnings", warnings).print();
    return absl::OkStatus();
  }
  absl::PrintF("area     %.9g\nvolume   %.9g\n", m->area(), m->volume());
  if (m->centroid_size() == 3) {
    absl::PrintF("centroid %.9g %.9g %.9g\n", m->centroid(0), m->centroid(1), m->centroid(2));
  }
  if (m->bounds_min_size() == 3 && m->bounds_max_size() == 3) {
    absl::PrintF("bounds   %.9g %.9g %.9g to %.9g %.9g %.9g\n", m->bounds_min(0), m->bounds_min(1), m->bounds_min(2),
                 m->bounds_max(0), m->bounds_max(1), m->bounds_max(2));
  }
  absl::PrintF("mesh     %s%u vertices, %u triangles, cell %g\n", shells_clause(m->summary()), m->summary().vertices(),
               m->summary().triangles(), m->summary().cell_size());
  print_warnings(warnings);
  return absl::OkStatus();
}

}  // namespace

void add_measure_command(Command app, Context& context) {
  const auto flags = std::make_shared<MeshFlags>();
  flags->omit_normals = true;
  Command command =
      app.add_subcommand("measure", "Area, volume, centroid, bounds, bodies and voids of the surface's mesh");
  flags->add_to(command);
  command.callback([&context, flags] { context.outcome = measure(context, *flags); });
}

}  // namespace isofield
