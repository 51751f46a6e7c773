#include <CLI/CLI.hpp>
#include <memory>

#include "commands/point_table.h"

namespace isofield {

void add_project_command(CLI::App& app, Context& context) {
  struct Arguments : PointTableArguments {
    std::optional<double> tolerance;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "project", "Project points onto the surface along the gradient: x,y,z,nx,ny,nz,converged,residual");
  arguments->add_to(*command, "--points");
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "Distance to the surface at which a point is there, in model units (default: 1e-5 of the scene's "
                   "size)")
      ->check(CLI::Validator(check_positive, "above 0"));
  command->callback([&context, arguments] {
    context.outcome = answer_points(
        context, *arguments,
        [&](Client& client, const v1::SceneRef& scene, std::span<const float> xyz, Table& table) -> absl::Status {
          v1::ProjectPointsRequest request;
          *request.mutable_scene() = scene;
          if (arguments->iso) request.set_iso(*arguments->iso);
          if (arguments->tolerance) request.set_tolerance(*arguments->tolerance);
          const auto found = client.project(request, xyz);
          if (!found.ok()) return found.status();
          table.add_vectors({"x", "y", "z"}, found->positions);
          table.add_vectors({"nx", "ny", "nz"}, found->normals);
          table.add("converged", std::span<const std::uint8_t>(found->converged));
          table.add("residual", std::span<const float>(found->residuals));
          return absl::OkStatus();
        });
  });
}

}  // namespace isofield
