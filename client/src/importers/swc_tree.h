#pragma once

#include <vector>

#include "importers/swc_sample.h"
#include "isofield/import.h"

namespace isofield {

// Fills in `parent`. A sample without a parent in the file becomes a root; cycles are cut at their first sample.
void link_parents(std::vector<SwcSample>& samples, ImportReport& report);

// The samples' indices with each parent before its children. This is the file's order where possible, else depth first
// from each root. The parents must be linked.
std::vector<int> parents_first(const std::vector<SwcSample>& samples);

}  // namespace isofield
