#pragma once

#include <string>

#include "importers/vector3.h"
#include "isofield/import.h"

namespace isofield {

// The factors of the first usable line "# SCALE x y z" of a file; all are 1 where there is none or `apply` is false.
// Reports what the header states and whether it is applied.
Vector3 read_swc_scale(const std::string& text, bool apply, ImportReport& report);

}  // namespace isofield
