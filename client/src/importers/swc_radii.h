#pragma once

#include <absl/status/status.h>

#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// Gives every sample a radius. A sample without one gets ImportOptions::min_radius, or else its parent's, after the
// parent's own mending; a root gets that of its nearest descendant that has one, of several as near the first in the
// file. A sample that is thinner than ImportOptions::min_radius gets that.
//
// A tree that has lost its parent and has no radius at all is dropped. `outlines`: the samples, by index, that only lie
// on the outline of a soma; they need no radius and keep what they have. `order`: parents first; dropped samples are
// taken out. INVALID_ARGUMENT: a root without a radius for it; the message names its line.
absl::Status mend_radii(const std::vector<bool>& outlines, const ImportOptions& options, std::vector<int>& order,
                        std::vector<SwcSample>& samples, ImportReport& report);

}  // namespace isofield
