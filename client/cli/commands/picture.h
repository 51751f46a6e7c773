#pragma once

#include <absl/status/status.h>

#include <string>

#include "commands/mesh_flags.h"
#include "commands/view_flags.h"
#include "render/render.h"

namespace isofield {

// What the commands that draw a surface ask for, and the drawing itself.
struct PictureFlags {
  MeshFlags mesh;
  ViewFlags view;
  std::string output, size = "1280x960";

  void add_to(CLI::App& command);
  // What can be told before anything is asked for: of usage, or of the files that are to be written.
  absl::Status check() const;
  // Meshes the surface, draws it, writes the picture and keeps the view; then says so on the standard output.
  absl::Status draw(const Context& context, Client& client) const;
};

}  // namespace isofield
