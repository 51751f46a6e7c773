#pragma once

#include <absl/status/status.h>

#include "isofield/import.h"

namespace isofield {

// INVALID_ARGUMENT: an option out of its range.
absl::Status check(const ImportOptions& options);

// The range of a piece of this radius, where `factor` is the format's own.
double range_of(const ImportOptions& options, double factor, double radius);

// Adds the operator over all nodes that the scene has, and makes it the root. A single piece stays alone.
void join_pieces(ImportOperator op, v1::Scene& scene);

}  // namespace isofield
