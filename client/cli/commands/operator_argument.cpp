#include "commands/operator_argument.h"

#include "exit_codes.h"
#include "operators/parameters.h"

namespace isofield {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

absl::Status set_all(const std::vector<std::string>& parameters, Message& message) {
  for (const std::string& parameter : parameters) {
    if (auto status = set_parameter(parameter, message); !status.ok()) {
      return usage_error(std::string(status.message()));
    }
  }
  return absl::OkStatus();
}

// Returns the field of v1::Operator for a built-in operator, or nullptr if no built-in operator has this name.
const FieldDescriptor* built_in(const std::string& name) {
  const FieldDescriptor* field = v1::Operator::descriptor()->FindFieldByName(name);
  return field && field->containing_oneof() ? field : nullptr;
}

}  // namespace

void OperatorArgument::add_to(Command command) {
  command.add_option("NAME", name, "A built-in operator, a custom one of the server, or \"opening\"").required();
  command
      .add_option("--param", parameters,
                  "NAME=VALUE: a field of the operator, or of its opening or silhouette (`operator show` lists them). "
                  "Once for each: --param silhouette=bulge --param k=0.8")
      .one_argument_each();
}

absl::StatusOr<ChosenOperator> choose_operator(const OperatorArgument& argument, Client& client) {
  ChosenOperator chosen;
  if (argument.is_opening()) {
    if (auto status = set_all(argument.parameters, *chosen.request.mutable_opening()); !status.ok()) return status;
    return chosen;
  }
  const FieldDescriptor* field = built_in(argument.name);
  if (field) {
    chosen.message.GetReflection()->MutableMessage(&chosen.message, field);
  } else {
    auto got = client.get_operator(argument.name);
    if (!got.ok()) return got.status();
    chosen.message = std::move(*got->mutable_operator_());
    if (argument.parameters.empty()) {
      chosen.request.set_name(argument.name);
      return chosen;
    }
    const auto* kinds = v1::Operator::descriptor()->FindOneofByName("kind");
    field = chosen.message.GetReflection()->GetOneofFieldDescriptor(chosen.message, kinds);
    if (!field) return absl::InternalError("the server sent an operator without a kind");
  }
  Message& kind = *chosen.message.GetReflection()->MutableMessage(&chosen.message, field);
  if (auto status = set_all(argument.parameters, kind); !status.ok()) return status;
  *chosen.request.mutable_inline_() = chosen.message;
  return chosen;
}

}  // namespace isofield
