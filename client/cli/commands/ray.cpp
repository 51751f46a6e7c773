#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <memory>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/point_table.h"
#include "exit_codes.h"

namespace isofield {
namespace {

struct RayArguments : PointTableArguments {
  std::string directions;
  std::vector<double> direction, bounds;
  std::optional<double> cell, max_distance;
};

absl::StatusOr<std::vector<float>> read_directions(const RayArguments& arguments, std::size_t rays,
                                                   std::vector<std::string>& notes) {
  if (!arguments.directions.empty()) {
    return read_points(arguments.directions, notes, {VectorRole::kDirection, arguments.directions == arguments.points});
  }
  std::vector<float> all;
  for (std::size_t i = 0; i < rays; ++i) {
    for (const double x : arguments.direction) all.push_back(static_cast<float>(x));
  }
  return all;
}

absl::Status cast(Client& client, const v1::SceneRef& scene, const RayArguments& arguments,
                  std::span<const float> origins, Table& table, std::vector<std::string>& notes) {
  const auto directions = read_directions(arguments, origins.size() / 3, notes);
  if (!directions.ok()) return directions.status();
  v1::CastRaysRequest request;
  *request.mutable_scene() = scene;
  if (arguments.iso) request.set_iso(*arguments.iso);
  if (arguments.cell) request.set_cell_size(*arguments.cell);
  if (arguments.max_distance) request.set_max_distance(*arguments.max_distance);
  for (std::size_t i = 0; i < arguments.bounds.size(); ++i) {
    (i < 3 ? request.mutable_bounds_min() : request.mutable_bounds_max())->Add(arguments.bounds[i]);
  }
  const auto hits = client.cast_rays(request, origins, *directions);
  if (!hits.ok() && absl::StartsWith(hits.status().message(), "cell_size")) {
    return absl::Status(hits.status().code(), absl::StrCat(hits.status().message(), " (--cell)"));
  }
  if (!hits.ok()) return hits.status();
  std::vector<std::string> names;
  for (const std::uint32_t node : hits->nodes) names.push_back(node == RayHits::kNothing ? "" : hits->names[node]);
  table.add("distance", std::span<const float>(hits->distances));
  table.add_vectors({"x", "y", "z"}, hits->positions);
  table.add_vectors({"nx", "ny", "nz"}, hits->normals);
  table.add("inside", std::span<const std::uint8_t>(hits->inside));
  table.add_texts("node", std::move(names));
  return absl::OkStatus();
}

}  // namespace

void add_ray_command(Command app, Context& context) {
  const auto arguments = std::make_shared<RayArguments>();
  Command command = app.add_subcommand(
      "ray", "Find where rays first meet the surface: distance (inf: no hit),x,y,z,nx,ny,nz,inside,node");
  arguments->add_to(command, "--origins");
  Option each = command.add_option("--directions", arguments->directions,
                                   "A direction for each origin, of any length but 0: columns dx, dy, dz, or the "
                                   "normals nx, ny, nz, or x, y, z. A file that has the origins too names them ox, oy, "
                                   "oz, or has six columns without names");
  command.add_option("--direction", arguments->direction, "x,y,z: one direction for all rays, of any length but 0")
      .check(number())
      .delimiter(',')
      .expected(3)
      .excludes(each);
  command
      .add_option("--max-distance", arguments->max_distance,
                  "Length of the rays, in model units (default: they do not end)")
      .check(positive());
  command
      .add_option("--cell", arguments->cell,
                  "Edge length of a cell, in model units; parts thinner than this along a ray may be missed (default: "
                  "chosen by the server after the thinnest part)")
      .check(positive());
  command
      .add_option("--bounds", arguments->bounds,
                  "x0,y0,z0,x1,y1,z1: the box in which to look for the surface, in model units")
      .check(number())
      .delimiter(',')
      .expected(6);
  command.callback([&context, arguments] {
    if (arguments->directions.empty() && arguments->direction.empty()) {
      context.outcome = usage_error("the rays have no direction; state --directions FILE or --direction x,y,z");
      return;
    }
    if (arguments->directions == "-" && arguments->points == "-") {
      context.outcome = usage_error("--origins - --directions -: the standard input can be read once; name a file");
      return;
    }
    context.outcome = answer_points(
        context, *arguments,
        [&](Client& client, const v1::SceneRef& scene, std::span<const float> origins, Table& table,
            std::vector<std::string>& notes) { return cast(client, scene, *arguments, origins, table, notes); },
        {VectorRole::kOrigin});
  });
}

}  // namespace isofield
