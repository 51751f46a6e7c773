#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace isofield {

// Says in a sentence what is wrong with a command line and what is accepted. An unknown command or option comes with
// the nearest known one, a missing or unreadable value with the option's description.
std::string explain_usage(const CLI::App& app, const CLI::ParseError& error);

// Returns the command that the user chose, with all commands above it, such as "isofield operator eval".
std::string chosen_command(const CLI::App& app);

}  // namespace isofield
