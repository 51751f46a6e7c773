#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/point_table.h"

namespace isofield {

void add_project_command(Command app, Context& context) {
  struct Arguments : PointTableArguments {
    std::optional<double> tolerance;
  };
  const auto arguments = std::make_shared<Arguments>();
  Command command = app.add_subcommand(
      "project",
      "Project points onto the surface along the gradient: x,y,z,nx,ny,nz,converged,residual,out_of_reach. Points "
      "where the field is constant are out of reach, for no gradient leads from there: those outside of all supports "
      "(farther from every primitive than its range) and, of positive fields, those deep inside of one. They stay "
      "where they are, with out_of_reach 1, converged 0 and an infinite residual. So do points whose "
      "path along the gradient ends in such a place");
  arguments->add_to(command, "--points");
  command
      .add_option("--tolerance", arguments->tolerance,
                  "Distance from the surface up to which a point has converged, in model units (default: 1e-5 of the "
                  "longest edge of the scene's support box)")
      .check(positive());
  command.callback([&context, arguments] {
    context.outcome =
        answer_points(context, *arguments,
                      [&](Client& client, const v1::SceneRef& scene, std::span<const float> xyz, Table& table,
                          std::vector<std::string>& notes) -> absl::Status {
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
                        // The residual is infinite where the gradient vanishes.
                        std::vector<std::uint8_t> out_of_reach;
                        for (std::size_t i = 0; i < found->residuals.size(); ++i) {
                          out_of_reach.push_back(found->converged[i] == 0 && std::isinf(found->residuals[i]) ? 1 : 0);
                        }
                        table.add("out_of_reach", std::span<const std::uint8_t>(out_of_reach));
                        const auto count = std::count(out_of_reach.begin(), out_of_reach.end(), 1);
                        if (count > 0) {
                          notes.push_back(absl::StrCat(count, " of ", out_of_reach.size(),
                                                       " points are out of reach of the surface (out_of_reach 1)"));
                        }
                        return absl::OkStatus();
                      });
  });
}

}  // namespace isofield
