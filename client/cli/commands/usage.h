#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace isofield {

// What is wrong with a command line and what is accepted, in a sentence: an unknown command or option comes with the
// nearest one, a missing or unreadable value with the option's description.
std::string explain_usage(const CLI::App& app, const CLI::ParseError& error);

// The command that was chosen with the commands above it: "isofield operator eval".
std::string chosen_command(const CLI::App& app);

}  // namespace isofield
