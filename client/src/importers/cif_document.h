// Parses CIF and mmJSON texts.
#pragma once

#include <absl/status/statusor.h>

#include <gemmi/cifdoc.hpp>
#include <string>

namespace isofield {

// These return the values of a CIF or an mmJSON text. INVALID_ARGUMENT: it is no such text; for CIF the message states
// the line.
absl::StatusOr<gemmi::cif::Document> read_cif(const std::string& text);
absl::StatusOr<gemmi::cif::Document> read_mmjson(std::string text);

}  // namespace isofield
