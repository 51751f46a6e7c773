// Links the samples of a neuron to trees.
#pragma once

#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// Fills in SwcSample::parent. A sample whose parent is not in the file becomes a root; cycles are cut at their first
// sample.
void link_parents(std::vector<SwcSample>& samples, ImportReport& report);

// Returns the indices of the samples with each parent before its children. This is the order of the file where
// possible, else depth first from each root. The parents must be linked.
std::vector<int> parents_first(const std::vector<SwcSample>& samples);

}  // namespace isofield
