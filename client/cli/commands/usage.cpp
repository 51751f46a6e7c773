#include "commands/usage.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "nearest_name.h"

namespace isofield {
namespace {

// Returns the program, the commands below it that the user chose, and last the command that is run.
std::vector<const CLI::App*> chain_of(const CLI::App& app) {
  std::vector<const CLI::App*> chain{&app};
  while (!chain.back()->get_subcommands().empty()) chain.push_back(chain.back()->get_subcommands().front());
  return chain;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string explain_extra(const std::vector<const CLI::App*>& chain, const std::string& extra) {
  const std::string command = chosen_command(*chain.front());
  if (!absl::StartsWith(extra, "-")) {
    const std::vector<std::string> commands = commands_of(*chain.back());
    if (commands.empty()) return absl::StrCat("\"", extra, "\": ", command, " takes no further argument");
    return absl::StrCat("\"", extra, "\": no such command of ", command, did_you_mean(extra, commands), "; expected ",
                        absl::StrJoin(commands, ", "));
  }
  const std::string wanted = extra.substr(0, extra.find('='));
  std::vector<std::string> names;
  for (const CLI::App* app : chain) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return absl::StrCat(wanted, ": no such option of ", command, did_you_mean(wanted, names));
}

// Returns the option or argument that CLI11's message is about, or nullptr if it is about none.
const CLI::Option* option_in(const std::string& message, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    std::vector<std::string> names;
    if (option->get_positional()) names.push_back(option->get_name(true));
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : names) {
      for (const char* const end : {" ", ":"}) {
        if (absl::StartsWith(message, name + end) || absl::StrContains(message, " " + name + end)) return option;
      }
      if (absl::EndsWith(message, " " + name)) return option;
    }
  }
  return nullptr;
}

}  // namespace

std::string chosen_command(const CLI::App& app) {
  return absl::StrJoin(chain_of(app), " ",
                       [](std::string* out, const CLI::App* one) { absl::StrAppend(out, one->get_name()); });
}

std::string explain_usage(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<const CLI::App*> chain = chain_of(app);
  // Unknown words come before missing options: a misspelt option leaves the real one missing.
  for (const CLI::App* one : chain) {
    const std::vector<std::string> extras = one->remaining();
    if (!extras.empty()) return explain_extra(chain, extras.front());
  }
  const std::string what = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) && absl::StrContains(what, "subcommand")) {
    return absl::StrCat("a command is missing; expected ", absl::StrJoin(commands_of(*chain.back()), ", "));
  }
  // The checks of checks.h say what they expect, and so does CLI11's check of choices ("not in {...}").
  if (absl::StrContains(what, ": expected ") || absl::StrContains(what, " not in {")) return what;
  for (const CLI::App* one : chain) {
    const CLI::Option* option = option_in(what, *one);
    if (option != nullptr && !option->get_description().empty()) {
      return absl::StrCat(what, "; ", option->get_name(false, true), " is: ", option->get_description());
    }
  }
  return what;
}

}  // namespace isofield
