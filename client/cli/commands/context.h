#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <string>

#include "commands/command_line.h"
#include "isofield/client.h"

namespace isofield {

// What all commands share: the global options, and where the chosen command leaves its outcome.
struct Context {
  std::string server;
  // Standard output is for machines: one JSON object.
  bool json = false;
  // Seconds, for every request; 0: the client's defaults.
  double timeout = 0;
  absl::Status outcome;

  absl::StatusOr<Client> connect(bool shared_memory = false) const;
};

// Each adds its commands to the command line, and runs the chosen one when it is parsed.
void add_catalog_commands(Command app, Context& context);  // put, ls, show, rm, edit
void add_import_command(Command app, Context& context);
void add_eval_command(Command app, Context& context);
void add_mesh_command(Command app, Context& context);
void add_render_command(Command app, Context& context);
void add_watch_command(Command app, Context& context);
void add_measure_command(Command app, Context& context);
void add_ray_command(Command app, Context& context);
void add_project_command(Command app, Context& context);
void add_inside_command(Command app, Context& context);
void add_slice_command(Command app, Context& context);
void add_operator_commands(Command app, Context& context);  // operator ls, show, put, rm, eval, plot, pick
void add_operator_eval_command(Command app, Context& context);
void add_operator_plot_command(Command app, Context& context);
void add_info_command(Command app, Context& context);

}  // namespace isofield
