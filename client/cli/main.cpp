#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "commands/context.h"
#include "exit_codes.h"
#include "output_file.h"
#include "version.h"

int main(int argc, char** argv) {
  using namespace isofield;
  remove_output_when_interrupted();
  Context context;
  CLI::App app("Blob-tree scenes on a GPU: the command line of isofieldd.\n", "isofield");
  app.set_version_flag("--version", "isofield " ISOFIELD_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit codes: 0 success; 1 the server refused the request or failed; 2 wrong usage; 3 no server answers;\n"
      "4 a file cannot be read, understood or written.");
  app.add_option("--server", context.server, "HOST:PORT, [IPV6]:PORT or unix:PATH")
      ->envname("ISOFIELD_SERVER")
      ->default_str("127.0.0.1:50051");
  app.add_option("--timeout", context.timeout, "Seconds for each request (default: 60; none for meshes and streams)")
      ->check(CLI::Validator(check_positive, "above 0"));
  app.add_flag("--json", context.json, "One JSON object on the standard output, for machines");
  add_catalog_commands(app, context);
  add_import_command(app, context);
  add_eval_command(app, context);
  add_mesh_command(app, context);
  add_render_command(app, context);
  add_measure_command(app, context);
  add_ray_command(app, context);
  add_project_command(app, context);
  add_inside_command(app, context);
  add_slice_command(app, context);
  add_operator_commands(app, context);
  add_info_command(app, context);
  context.server = "127.0.0.1:50051";
  try {
    // "-.5" is a number; CLI11 would take it for an option.
    std::vector<std::string> arguments(argv, argv + argc);
    for (std::string& text : arguments) {
      if (text.size() > 2 && text[0] == '-' && text[1] == '.' && text[2] >= '0' && text[2] <= '9') text.insert(1, "0");
    }
    std::vector<const char*> texts;
    for (const std::string& text : arguments) texts.push_back(text.c_str());
    app.parse(argc, texts.data());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kWrongUsage;
  }
  if (!context.outcome.ok()) {
    const std::string message(context.outcome.message());
    std::fprintf(stderr, "isofield: %s\n", message.c_str());
  }
  // A full disk or a closed pipe shows when the output is flushed.
  if (std::fflush(stdout) != 0 && context.outcome.ok()) {
    std::perror("isofield: standard output");
    return kFileFailed;
  }
  return exit_code(context.outcome);
}
