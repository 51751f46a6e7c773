// Makes the pieces of a scene from the samples of a neuron.
#pragma once

#include <vector>

#include "importers/swc_sample.h"
#include "importers/swc_soma.h"
#include "isofield/import.h"

namespace isofield {

// The default of ImportOptions::range_factor for neurons: the ratio of the range of a piece to its radius.
inline constexpr double kSwcRangeFactor = 1;

// Turns linked samples with radii into the pieces of a scene, and reports what is left out. `order` lists the samples'
// indices with each parent before its children; the pieces come in this order.
void make_pieces(const std::vector<SwcSample>& samples, const std::vector<int>& order, const Somata& somata,
                 const ImportOptions& options, Imported& imported);

// Adds a sphere at the sample, with its radius and name.
void add_sphere(const SwcSample& sample, const ImportOptions& options, v1::Scene& scene);

}  // namespace isofield
