#pragma once

#include <vector>

#include "importers/swc_sample.h"
#include "importers/swc_soma.h"
#include "isofield/import.h"

namespace isofield {

// The range of a neuron's piece over its radius, without ImportOptions::range_factor.
inline constexpr double kSwcRangeFactor = 1;

// Turns linked samples with radii into the pieces of a scene, parents first, and reports what is left out. `order`:
// parents first.
void make_pieces(const std::vector<SwcSample>& samples, const std::vector<int>& order, const Somata& somata,
                 const ImportOptions& options, Imported& imported);

// A ball at the sample, named after it.
void add_sphere(const SwcSample& sample, const ImportOptions& options, v1::Scene& scene);

}  // namespace isofield
