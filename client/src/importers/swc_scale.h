// Reads the scale that an SWC file may state in its header.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "isofield/import.h"

namespace isofield {

// Returns the factors of the first usable line "# SCALE x y z" of a file; all are 1 where there is none or `apply` is
// false. Reports what the header states and whether it is applied.
glm::dvec3 read_swc_scale(const std::string& text, bool apply, ImportReport& report);

}  // namespace isofield
