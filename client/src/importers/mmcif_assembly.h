#pragma once

#include <absl/status/statusor.h>

#include <gemmi/cifdoc.hpp>
#include <string>
#include <vector>

#include "importers/molecule.h"

namespace isofield {

// The assemblies that a block of mmCIF describes. gemmi's own reader leaves out products of operators, as capsids have
// them, and assemblies whose description it does not know.
std::vector<Assembly> read_assemblies(gemmi::cif::Block& block);

// The names of an operator expression such as "1,2", "(1-60)" or "(X0)(1-5)"; of each product, in the order in which
// its factors stand: the last one is applied first. INVALID_ARGUMENT: brackets do not match, or there are more than
// 100,000.
absl::StatusOr<std::vector<std::vector<std::string>>> expand_operators(absl::string_view expression);

}  // namespace isofield
