#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>

#include <cstdio>
#include <memory>

#include "commands/catalog_listing.h"
#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "isofield/scene_file.h"

namespace isofield {
namespace {

std::string describe(const v1::SceneSummary& summary) {
  return absl::StrCat(summary.name(), ": version ", summary.version(), ", ", summary.nodes(), " nodes, ",
                      summary.primitives(), " primitives, ", summary.device_bytes(), " bytes on the device");
}

std::vector<std::string> row_of(const v1::SceneSummary& summary) {
  return {summary.name(), absl::StrCat(summary.version()), absl::StrCat(summary.nodes()),
          absl::StrCat(summary.primitives()), absl::StrCat(summary.device_bytes())};
}

const Catalog<v1::SceneSummary>& scenes() {
  static const auto* const kScenes =
      new Catalog<v1::SceneSummary>{"scenes",
                                    &Client::list_scenes,
                                    &Client::delete_scene,
                                    describe,
                                    {{"NAME", -32}, {"VERSION", 10}, {"NODES", 10}, {"PRIMITIVES", 12}, {"BYTES", 14}},
                                    row_of};
  return *kScenes;
}

absl::Status put(const Context& context, const std::string& file, const std::string& name, const ImportFlags& flags) {
  auto loaded = load_scene(file, flags.get());
  if (!loaded.ok()) return loaded.status();
  auto client = context.connect();
  if (!client.ok()) return client.status();
  return print_entry(context, scenes(),
                     client->put_scene(name.empty() ? name_for(file) : name, std::move(loaded->scene)));
}

absl::Status show(const Context& context, const std::string& name) {
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto response = client->get_scene(name);
  if (!response.ok()) return response.status();
  if (context.json) {
    print_json(*response);
    return absl::OkStatus();
  }
  const auto text = format_scene_json(response->scene());
  if (!text.ok()) return text.status();
  std::fprintf(stderr, "%s\n", describe(response->summary()).c_str());
  std::fwrite(text->data(), 1, text->size(), stdout);
  return absl::OkStatus();
}

// Parses "NODE.FIELD=v[,v..]". The first dot ends the node, since a node's name has no dot.
absl::Status parse_edit(const std::string& text, v1::ParameterEdit& edit) {
  const std::size_t equals = text.rfind('=');
  const std::size_t dot = text.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals) {
    return usage_error(absl::StrCat("\"", text, "\": expected NODE.FIELD=NUMBER[,NUMBER..], such as arm.radius=2"));
  }
  edit.set_node(text.substr(0, dot));
  edit.set_field(text.substr(dot + 1, equals - dot - 1));
  for (const absl::string_view number : absl::StrSplit(absl::string_view(text).substr(equals + 1), ',')) {
    double value = 0;
    if (!absl::SimpleAtod(number, &value)) {
      return usage_error(absl::StrCat("\"", text, "\": \"", number, "\" is not a number; expected NUMBER[,NUMBER..]"));
    }
    edit.add_values(value);
  }
  return absl::OkStatus();
}

absl::Status edit(const Context& context, const std::string& name, const std::vector<std::string>& edits,
                  std::uint64_t expected_version) {
  v1::EditParametersRequest request;
  request.set_name(name);
  request.set_expected_version(expected_version);
  for (const std::string& text : edits) {
    if (auto status = parse_edit(text, *request.add_edits()); !status.ok()) return status;
  }
  auto client = context.connect();
  if (!client.ok()) return client.status();
  return print_entry(context, scenes(), client->edit_parameters(request));
}

}  // namespace

void add_catalog_commands(Command app, Context& context) {
  struct Arguments {
    std::string file, name;
    ImportFlags flags;
    std::vector<std::string> edits;
    std::uint64_t version = 0;
  };
  // The commands' callbacks live as long as the app, and so must what they read.
  const auto arguments = std::make_shared<Arguments>();

  Command command = app.add_subcommand("put", "Store a scene on the server, replacing one of that name");
  command
      .add_option("FILE", arguments->file,
                  "Scene (.json, .pb), or a file to import (.swc, .pdb, .cif, .xyz, .txt, .csv)")
      .required();
  command.add_option("--name", arguments->name, "Name on the server (default: the file's, without its extension)");
  arguments->flags.add_to(command);
  command.callback(
      [&context, arguments] { context.outcome = put(context, arguments->file, arguments->name, arguments->flags); });

  command = app.add_subcommand("ls", "List the server's scenes");
  command.callback([&context] { context.outcome = list_catalog(context, scenes()); });

  command = app.add_subcommand("show", "Print a scene of the server as JSON");
  command.add_option("NAME", arguments->name, "A scene's name on the server, as `ls` lists it").required();
  command.callback([&context, arguments] { context.outcome = show(context, arguments->name); });

  command = app.add_subcommand("rm", "Delete a scene of the server");
  command.add_option("NAME", arguments->name, "A scene's name on the server, as `ls` lists it").required();
  command.callback([&context, arguments] { context.outcome = remove_entry(context, scenes(), arguments->name); });

  command = app.add_subcommand("edit", "Change numbers of a scene on the server; if one cannot be changed, none is");
  command.add_option("NAME", arguments->name, "A scene's name on the server, as `ls` lists it").required();
  command
      .add_option("EDITS", arguments->edits,
                  "NODE.FIELD=NUMBER[,NUMBER..] ..., such as arm.radius=2 '#0.center=1,0,0' bar.radiusA=0.1 "
                  "all.opening.alpha0=10. A node is its name or #i, its place in the scene from 0; a field's name is "
                  "the one of scene.proto or of JSON")
      .required();
  command.add_option("--expect-version", arguments->version, "Only if the scene has this version (default: 0, any)")
      .check(whole(0, UINT64_MAX));
  command.callback([&context, arguments] {
    context.outcome = edit(context, arguments->name, arguments->edits, arguments->version);
  });
}

}  // namespace isofield
