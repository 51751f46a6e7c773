#include <memory>

#include "commands/command_line.h"
#include "commands/point_table.h"

namespace isofield {

void add_inside_command(Command app, Context& context) {
  const auto arguments = std::make_shared<PointTableArguments>();
  Command command = app.add_subcommand("inside", "Tell which points are inside the surface: x,y,z,inside");
  arguments->add_to(command, "--points");
  command.callback([&context, arguments] {
    context.outcome = answer_points(context, *arguments,
                                    [&](Client& client, const v1::SceneRef& scene, std::span<const float> xyz,
                                        Table& table, std::vector<std::string>&) -> absl::Status {
                                      v1::ContainsRequest request;
                                      *request.mutable_scene() = scene;
                                      if (arguments->iso) request.set_iso(*arguments->iso);
                                      const auto inside = client.contains(request, xyz);
                                      if (!inside.ok()) return inside.status();
                                      table.add_vectors({"x", "y", "z"}, xyz);
                                      table.add("inside", std::span<const std::uint8_t>(*inside));
                                      return absl::OkStatus();
                                    });
  });
}

}  // namespace isofield
