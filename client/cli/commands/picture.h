#pragma once

#include <absl/status/status.h>

#include <string>

#include "commands/command_line.h"
#include "commands/mesh_flags.h"
#include "commands/view_flags.h"
#include "render/render.h"

namespace isofield {

// The options of the commands that draw a surface, and the drawing itself.
struct PictureFlags {
  MeshFlags mesh;
  ViewFlags view;
  std::string output, size = "1280x960";

  void add_to(Command command);
  // Finds errors of usage, and of the files to be written, before the server is asked for anything.
  absl::Status check() const;
  // Meshes the surface, draws it, writes the picture and keeps the view. Prints a line, or an object for --json.
  absl::Status draw(const Context& context, Client& client) const;
};

}  // namespace isofield
