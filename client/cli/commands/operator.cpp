#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_join.h>

#include <cstdio>
#include <memory>

#include "commands/catalog_listing.h"
#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/scene_argument.h"
#include "exit_codes.h"
#include "isofield/operator_file.h"
#include "json_output.h"
#include "operators/parameters.h"

namespace isofield {
namespace {

std::string law_of(const v1::OperatorSummary& summary) {
  return summary.law() == v1::POSITIVE ? "positive" : summary.law() == v1::SIGNED ? "signed" : "either";
}

std::string version_of(const v1::OperatorSummary& summary) {
  return summary.version() == 0 ? "built in" : absl::StrCat(summary.version());
}

std::string describe(const v1::OperatorSummary& summary) {
  return absl::StrCat(summary.name(), ": version ", version_of(summary), ", ", summary.kind(), ", ", law_of(summary),
                      " fields, ", absl::StrJoin(summary.arguments(), ","));
}

std::vector<std::string> row_of(const v1::OperatorSummary& summary) {
  return {summary.name(), summary.kind(), law_of(summary), version_of(summary),
          absl::StrJoin(summary.arguments(), ",")};
}

const Catalog<v1::OperatorSummary>& operators() {
  static const auto* const kOperators =
      new Catalog<v1::OperatorSummary>{"operators",
                                       &Client::list_operators,
                                       &Client::delete_operator,
                                       describe,
                                       {{"NAME", -24}, {"KIND", -14}, {"FIELDS", -9}, {"VERSION", 9}, {"ARGUMENTS", 0}},
                                       row_of};
  return *kOperators;
}

absl::Status put(const Context& context, const std::string& file, const std::string& name) {
  auto message = read_operator_file(file);
  if (!message.ok()) return file_error(message.status());
  auto client = context.connect();
  if (!client.ok()) return client.status();
  return print_entry(context, operators(),
                     client->put_operator(name.empty() ? name_for(file) : name, *std::move(message)));
}

// Returns the parameters that operators of this kind have.
std::vector<Parameter> parameters_of(const v1::Operator& message) {
  const auto* kinds = v1::Operator::descriptor()->FindOneofByName("kind");
  const auto* kind = message.GetReflection()->GetOneofFieldDescriptor(message, kinds);
  if (!kind) return {};
  return describe_parameters(message.GetReflection()->GetMessage(message, kind));
}

absl::Status show(const Context& context, const std::string& name) {
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto response = client->get_operator(name);
  if (!response.ok()) return response.status();
  const std::vector<Parameter> parameters = parameters_of(response->operator_());
  if (context.json) {
    std::vector<JsonObject> list;
    for (const auto& [parameter, range] : parameters) {
      JsonObject& one = list.emplace_back();
      one.set("name", parameter).set("accepts", range.accepts).set("required", range.otherwise.empty());
      if (!range.otherwise.empty()) one.set("default", range.otherwise);
    }
    JsonObject(*response).set("parameters", list).print();
    return absl::OkStatus();
  }
  const auto text = format_operator_json(response->operator_());
  if (!text.ok()) return text.status();
  std::fwrite(text->data(), 1, text->size(), stdout);
  // The parameters go to the standard error, since the standard output is a file for `operator put`.
  std::fflush(stdout);
  absl::FPrintF(stderr, "%s\n", parameters.empty() ? "It has no parameters." : "Parameters of this kind of operator:");
  for (const auto& [parameter, range] : parameters) {
    absl::FPrintF(stderr, "  %s: %s; %s\n", parameter, range.accepts,
                  range.otherwise.empty() ? "it must be stated" : "default: " + range.otherwise);
  }
  return absl::OkStatus();
}

struct PickArguments {
  std::string scene, node;
  std::array<double, 3> point{};
  ImportFlags flags;
};

absl::Status pick(const Context& context, const PickArguments& arguments) {
  const auto scene = scene_argument(arguments.scene, arguments.flags.get());
  if (!scene.ok()) return scene.status();
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto picked = client->pick_opening(*scene, arguments.node, arguments.point);
  if (!picked.ok()) return picked.status();
  if (context.json) {
    print_json(*picked);
  } else {
    absl::PrintF("theta = %.6g at alpha = %.6g degrees; f1 = %.6g, f2 = %.6g\n", picked->theta(), picked->alpha(),
                 picked->f1(), picked->f2());
  }
  return absl::OkStatus();
}

}  // namespace

void add_operator_commands(Command app, Context& context) {
  struct Arguments {
    std::string file, name;
  };
  const auto arguments = std::make_shared<Arguments>();
  Command all = app.add_subcommand("operator", "Composition operators: keep, evaluate and draw them");
  all.require_subcommand();

  Command command = all.add_subcommand("ls", "List the built-in operators and the server's custom ones");
  command.callback([&context] { context.outcome = list_catalog(context, operators()); });

  command = all.add_subcommand(
      "show", "Print an operator as JSON, and on the standard error what its parameters accept and their defaults");
  command.add_option("NAME", arguments->name, "An operator's name, as `operator ls` lists it").required();
  command.callback([&context, arguments] { context.outcome = show(context, arguments->name); });

  command = all.add_subcommand("put", "Store a custom operator on the server, replacing one of that name");
  command.add_option("FILE", arguments->file, "Operator (.json, .pb)").required();
  command.add_option("--name", arguments->name, "Name on the server (default: the file's, without its extension)");
  command.callback([&context, arguments] { context.outcome = put(context, arguments->file, arguments->name); });

  command = all.add_subcommand("rm", "Delete a custom operator of the server; scenes that use it keep it");
  command.add_option("NAME", arguments->name, "An operator's name, as `operator ls` lists it").required();
  command.callback([&context, arguments] { context.outcome = remove_entry(context, operators(), arguments->name); });

  add_operator_eval_command(all, context);
  add_operator_plot_command(all, context);

  const auto picked = std::make_shared<PickArguments>();
  command = all.add_subcommand(
      "pick",
      "Tell the opening angle at which the blend of a node's two children would begin at a point of the first one's "
      "surface");
  command.add_option("SCENE", picked->scene, "A file, or else a name on the server").required();
  command.add_option("NODE", picked->node, "A node of two children, by name or #i").required();
  command.add_option("X", picked->point[0], "A point X Y Z of the first child's surface, in the node's own frame")
      .check(number())
      .required();
  command.add_option("Y", picked->point[1], "Its second coordinate").check(number()).required();
  command.add_option("Z", picked->point[2], "Its third coordinate").check(number()).required();
  command.callback([&context, picked] { context.outcome = pick(context, *picked); });
}

}  // namespace isofield
