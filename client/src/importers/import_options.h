#pragma once

#include <absl/status/status.h>

#include <vector>

#include "isofield/import.h"

namespace isofield {

// INVALID_ARGUMENT: an option out of its range.
absl::Status check(const ImportOptions& options);

// The range of a piece of this radius. `factor` is the format's default for ImportOptions::range_factor. The result is
// clamped to lengths that the server accepts.
double range_of(const ImportOptions& options, double factor, double radius);

// The indices of the nodes that are pieces. Of a shape and the transform that places it, the transform is the piece.
std::vector<int> find_pieces(const v1::Scene& scene);

// Adds the operator over all pieces that the scene has, and makes it the root. A single piece stays alone.
void join_pieces(ImportOperator op, v1::Scene& scene);

}  // namespace isofield
