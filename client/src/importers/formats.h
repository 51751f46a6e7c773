// The importers of the formats.
#pragma once

#include <absl/status/status.h>

#include <string>

#include "isofield/import.h"

namespace isofield {

// Each function adds the pieces of its format to an empty scene, sets the unit that the format implies, and fills in
// the report. INVALID_ARGUMENT: the text cannot be of this format, or it lacks something that has no default.
absl::Status import_swc(const std::string& text, const ImportOptions& options, Imported& imported);
absl::Status import_pdb(const std::string& text, const ImportOptions& options, Imported& imported);
absl::Status import_mmcif(const std::string& text, const ImportOptions& options, Imported& imported);
absl::Status import_xyz(const std::string& text, const ImportOptions& options, Imported& imported);
absl::Status import_points(const std::string& text, const ImportOptions& options, Imported& imported);

}  // namespace isofield
