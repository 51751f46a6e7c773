// Checks and applies the import options that all formats share.
#pragma once

#include <absl/status/status.h>

#include <vector>

#include "isofield/import.h"

namespace isofield {

// Checks the options. INVALID_ARGUMENT: one of them is out of its range.
absl::Status check(const ImportOptions& options);

// Returns the range of a piece of this radius. `factor` is the default of the format for ImportOptions::range_factor.
// The result is clamped to lengths that the server accepts.
double range_of(const ImportOptions& options, double factor, double radius);

// Returns the indices of the nodes that are pieces. Where a transform places a shape, the transform is the piece.
std::vector<int> find_pieces(const v1::Scene& scene);

// Adds the operator over all pieces that the scene has, and makes it the root. A single piece gets no operator.
void join_pieces(ImportOperator op, v1::Scene& scene);

}  // namespace isofield
