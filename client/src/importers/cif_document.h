#pragma once

#include <absl/status/statusor.h>

#include <gemmi/cifdoc.hpp>
#include <string>

namespace isofield {

// The values of a CIF or mmJSON text. INVALID_ARGUMENT: it is not one; the message has the line.
absl::StatusOr<gemmi::cif::Document> read_cif(const std::string& text);
absl::StatusOr<gemmi::cif::Document> read_mmjson(std::string text);

}  // namespace isofield
