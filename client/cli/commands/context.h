#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <string>

#include "commands/command_line.h"
#include "isofield/client.h"

namespace isofield {

// The state that all commands share: the global options, and the outcome that the chosen command leaves for main().
struct Context {
  std::string server;
  // True if the standard output gets one JSON object, for machines, instead of text.
  bool json = false;
  // The time that each request may take, in seconds; 0 stands for the client's defaults.
  double timeout = 0;
  absl::Status outcome;

  // Makes a client, which connects with its first request. An address that cannot be read is an error of usage.
  absl::StatusOr<Client> connect(bool shared_memory = false) const;
};

// Each function adds its commands to the command line. Parsing the command line runs the command that was chosen.
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
