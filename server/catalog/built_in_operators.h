// Lists the built-in operators, which are always there: one for each kind of the contract's Operator message, under
// the name of that kind's field.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isofield/v1/operator.pb.h"

namespace isofield::catalog {

// Returns the names of all built-in operators, in the order of the contract.
const std::vector<std::string>& built_in_names();

// Returns the built-in operator `name` as a message: its kind is chosen, and no field of the kind is set. Returns
// nothing if no built-in operator has this name.
std::optional<v1::Operator> built_in_operator(const std::string& name);

// Returns the name of the kind that `message` has chosen, or "" if it has chosen none.
std::string kind_name(const v1::Operator& message);

}  // namespace isofield::catalog
