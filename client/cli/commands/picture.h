#pragma once

#include <absl/status/status.h>

#include <string>

#include "commands/command_line.h"
#include "commands/mesh_flags.h"
#include "commands/view_flags.h"
#include "render/render.h"

namespace isofield {

// The options of the commands that draw a picture of a surface. They also mesh the surface and draw it.
struct PictureFlags {
  MeshFlags mesh;
  ViewFlags view;
  std::string output, size = "1280x960";

  void add_to(Command command);
  // Returns an error of usage or of the files that will be read or written, before the server is asked for anything.
  absl::Status check() const;
  // Meshes the surface, draws it, writes the picture and keeps the view. Prints a line, or an object for --json.
  absl::Status draw(const Context& context, Client& client) const;
};

}  // namespace isofield
