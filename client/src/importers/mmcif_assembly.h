// Reads the biological assemblies of mmCIF files.
#pragma once

#include <absl/status/statusor.h>

#include <gemmi/cifdoc.hpp>
#include <string>
#include <vector>

#include "importers/molecule.h"

namespace isofield {

// Returns the assemblies that a block of mmCIF describes. The reader of gemmi is not used, since it leaves out products
// of operators, which capsids have, and assemblies whose description it does not know.
std::vector<Assembly> read_assemblies(gemmi::cif::Block& block);

// Expands an operator expression such as "1,2", "(1-60)" or "(X0)(1-5)" into products. Each product is a list of
// operators' names in the order of the expression; the last one is applied first. INVALID_ARGUMENT: a bracket is not
// closed, a range descends, or there are more than 100,000 products.
absl::StatusOr<std::vector<std::vector<std::string>>> expand_operators(absl::string_view expression);

}  // namespace isofield
