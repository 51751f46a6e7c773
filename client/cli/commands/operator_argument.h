#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

#include "commands/command_line.h"
#include "commands/context.h"

namespace isofield {

// The arguments NAME and --param of the commands that evaluate an operator, or an opening function where the name is
// "opening".
struct OperatorArgument {
  std::string name;
  std::vector<std::string> parameters;

  void add_to(Command command);
  bool is_opening() const { return name == "opening"; }
};

// The operator or opening that the arguments choose.
struct ChosenOperator {
  v1::EvaluateOperatorRequest request;  // names or contains it; the columns are still missing
  v1::Operator message;                 // the operator; empty for an opening
};

// Finds a built-in operator, "opening", or a custom operator, for which it asks the server, and sets the parameters. A
// parameter or value that does not exist is an error of usage.
absl::StatusOr<ChosenOperator> choose_operator(const OperatorArgument& argument, Client& client);

}  // namespace isofield
