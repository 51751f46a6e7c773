#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/usage.h"
#include "error_report.h"
#include "exit_codes.h"
#include "output_file.h"
#include "version.h"

namespace isofield {
namespace {

// Returns the arguments with "-.5" rewritten as "-0.5", because CLI11 would take the former for an option.
std::vector<std::string> readable_arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  for (std::string& text : arguments) {
    if (text.size() > 2 && text[0] == '-' && text[1] == '.' && text[2] >= '0' && text[2] <= '9') text.insert(1, "0");
  }
  return arguments;
}

}  // namespace
}  // namespace isofield

int main(int argc, char** argv) {
  using namespace isofield;
  remove_output_when_interrupted();
  Context context;
  CLI::App app("Blob-tree scenes on a GPU: the command line of isofieldd.\n", "isofield");
  app.set_version_flag("--version", "isofield " ISOFIELD_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Each command has a --help of its own.\n"
      "Exit codes: 0 success; 1 the server refused the request or failed; 2 wrong usage; 3 no server answers;\n"
      "4 a file cannot be read, understood or written.\n"
      "With --json an error is {\"error\": {\"code\", \"message\", \"exit_code\"}} on the standard output, and the\n"
      "message is printed on the standard error too. Keys keep their order, numbers are JSON numbers, and infinities\n"
      "and NaN are null.");
  app.add_option("--server", context.server, "The server's address: HOST:PORT, [IPV6]:PORT or unix:PATH")
      ->envname("ISOFIELD_SERVER")
      ->default_str("127.0.0.1:50051");
  Command all(app);
  all.add_option("--timeout", context.timeout,
                 "Seconds that each request may take (default: 60; meshes and large evaluations as long as they need)")
      .check(positive());
  all.add_flag("--json", context.json,
               "Print one JSON object on the standard output, for machines, instead of text; watch prints one for "
               "each picture");
  add_catalog_commands(all, context);
  add_import_command(all, context);
  add_eval_command(all, context);
  add_mesh_command(all, context);
  add_render_command(all, context);
  add_watch_command(all, context);
  add_measure_command(all, context);
  add_ray_command(all, context);
  add_project_command(all, context);
  add_inside_command(all, context);
  add_slice_command(all, context);
  add_operator_commands(all, context);
  add_info_command(all, context);
  context.server = "127.0.0.1:50051";
  const std::vector<std::string> arguments = readable_arguments(argc, argv);
  try {
    std::vector<const char*> texts;
    for (const std::string& text : arguments) texts.push_back(text.c_str());
    app.parse(argc, texts.data());
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    context.outcome = usage_error(explain_usage(app, error));
    // CLI11 stops at an error, so that it may not have seen the flag.
    context.json = std::count(arguments.begin(), arguments.end(), "--json") > 0;
  }
  const ExitCode code = context.outcome.ok() ? kSuccess : report_error(context.outcome, context.json);
  if (code == kWrongUsage) std::fprintf(stderr, "%s --help says more.\n", chosen_command(app).c_str());
  // A full disk or a closed pipe shows when the output is flushed.
  if (std::fflush(stdout) != 0 && code == kSuccess) {
    std::perror("isofield: standard output");
    return kFileFailed;
  }
  return code;
}
