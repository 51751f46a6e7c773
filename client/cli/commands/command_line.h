// The command line as the commands see it: CLI11 behind a few calls of the same names. Each file that includes CLI11
// takes several seconds to compile, so command_line.cpp, usage.cpp and main.cpp alone do.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace isofield {

// A condition on the text of a value.
struct Check {
  // Says what is wrong with the text and what is expected. It returns an empty text where nothing is wrong.
  std::function<std::string(const std::string& text)> fault;
  // The condition in a few words, which --help prints beside the option.
  std::string range;
};

// An option or an argument of a command. Copies stand for the same option, which lives as long as the command line.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required();
  Option check(const Check& check);
  // Accepts these words alone.
  Option one_of(const std::vector<std::string>& words);
  // One argument may hold several values with this character between them.
  Option delimiter(char between);
  // How many values it takes.
  Option expected(int count);
  Option expected(int least, int most);
  // Several values come by the delimiter or by naming the option again, not as further arguments.
  Option one_argument_each();
  // It may not be stated together with the other.
  Option excludes(Option other);
  // --help shows the variable's present value as the default.
  Option shows_default();
  // Replaces the description.
  Option description(const std::string& text);
  // --help lists it under this heading.
  Option group(const std::string& heading);

 private:
  CLI::Option* option_;
};

// A command of the command line. Copies stand for the same command, which lives as long as the command line.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command add_subcommand(const std::string& name, const std::string& description);
  // One of the commands below it has to be chosen.
  void require_subcommand();
  // Adds an option ("-o,--output") or an argument ("FILE"). Parsing writes its value to the variable, which must live
  // as long as the command line. command_line.cpp lists the types of variables.
  template <class T>
  Option add_option(const std::string& names, T& variable, const std::string& description);
  // Adds an option without a value: parsing sets the variable.
  Option add_flag(const std::string& names, bool& variable, const std::string& description);
  // The option or argument of this name, which must be there.
  Option option(const std::string& name);
  // Parsing calls this where the user has chosen the command.
  void callback(std::function<void()> run);

 private:
  CLI::App* app_;
};

}  // namespace isofield
