// Reads the lines of SWC texts.
#pragma once

#include <string>
#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// Reads the usable lines of a text in their order. No two samples have the same id, and parents are not linked yet. The
// lines of the samples are views into the text. Coordinates are multiplied by `scale`, radii by the geometric mean of
// its factors. Lines that cannot be used are reported.
std::vector<SwcSample> read_swc_samples(const std::string& text, const glm::dvec3& scale, ImportReport& report);

}  // namespace isofield
