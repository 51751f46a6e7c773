#include <memory>

#include "commands/command_line.h"
#include "commands/picture.h"

namespace isofield {
namespace {

absl::Status render_scene(const Context& context, const PictureFlags& flags) {
  if (auto status = flags.check(); !status.ok()) return status;
  auto client = context.connect();
  if (!client.ok()) return client.status();
  return flags.draw(context, *client);
}

}  // namespace

void add_render_command(Command app, Context& context) {
  const auto flags = std::make_shared<PictureFlags>();
  Command command = app.add_subcommand("render", "Mesh the surface and draw a picture of it; y is up");
  flags->add_to(command);
  command.callback([&context, flags] { context.outcome = render_scene(context, *flags); });
}

}  // namespace isofield
