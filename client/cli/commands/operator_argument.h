#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

#include "commands/command_line.h"
#include "commands/context.h"

namespace isofield {

// NAME and --param of the commands that evaluate an operator.
struct OperatorArgument {
  std::string name;
  std::vector<std::string> parameters;

  void add_to(Command command);
  bool is_opening() const { return name == "opening"; }
};

// An operator to be evaluated.
struct ChosenOperator {
  v1::EvaluateOperatorRequest request;  // states it; no columns yet
  v1::Operator message;                 // of an opening: none
};

// A built-in operator, "opening", or a custom operator of the server, with the parameters set. An error of usage: no
// such parameter or value.
absl::StatusOr<ChosenOperator> choose_operator(const OperatorArgument& argument, Client& client);

}  // namespace isofield
