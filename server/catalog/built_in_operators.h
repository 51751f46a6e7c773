// The operators that are always there: one for each kind of the contract's Operator message, under its field's name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isofield/v1/operator.pb.h"

namespace isofield::catalog {

// In the order of the contract.
const std::vector<std::string>& built_in_names();

// With its kind chosen and no field of that set. Nothing: not the name of one.
std::optional<v1::Operator> built_in_operator(const std::string& name);

// The name of the kind that is chosen; empty: none is.
std::string kind_name(const v1::Operator& message);

}  // namespace isofield::catalog
