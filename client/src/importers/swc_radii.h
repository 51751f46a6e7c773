// Finds radii for the samples of a neuron that have none.
#pragma once

#include <absl/status/status.h>

#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// Gives every sample a radius. A sample without one gets ImportOptions::min_radius. Without that option it gets its
// parent's radius, which may have been mended itself, and a root gets that of its nearest descendant that has one; of
// several equally near descendants the first in the file counts. A sample that is thinner than
// ImportOptions::min_radius gets that radius.
//
// A tree that has lost its parent and has no radius at all is dropped. `outlines` is true for each sample that only
// lies on the outline of a soma; these need no radius and keep what they have. `order` lists the samples' indices with
// parents first; dropped samples are removed from it. INVALID_ARGUMENT: there is no radius for a root; the message
// names its line.
absl::Status mend_radii(const std::vector<bool>& outlines, const ImportOptions& options, std::vector<int>& order,
                        std::vector<SwcSample>& samples, ImportReport& report);

}  // namespace isofield
