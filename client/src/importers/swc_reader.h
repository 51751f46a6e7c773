#pragma once

#include <absl/strings/string_view.h>

#include <string>
#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// The usable lines of a text, in its order, with different ids; parents are not linked. The samples' lines refer to the
// text. Coordinates are multiplied by `scale`, radii by the geometric mean of its factors. What cannot be used is
// reported.
std::vector<SwcSample> read_swc_samples(const std::string& text, const Vector3& scale, ImportReport& report);

// Whether a text that is not named so is a neuron: its first line that is no comment has the seven columns, a whole id,
// a type from 0 to 255 and the parent -1.
bool looks_like_swc(absl::string_view text);

}  // namespace isofield
