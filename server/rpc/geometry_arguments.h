// Reads vectors, lengths, bounds and iso values of requests, which several services have in common. All functions
// refuse with INVALID_ARGUMENT.
#pragma once

#include <absl/status/statusor.h>
#include <google/protobuf/repeated_field.h>

#include <optional>

#include "blobtree/tape/tape.h"

namespace isofield::rpc {

using Numbers = google::protobuf::RepeatedField<double>;

// Reads a vector: 3 numbers of magnitude at most kMaxCoordinate.
absl::StatusOr<blobtree::dvec3> read_vector(const char* name, const Numbers& v);
void set_vector(const blobtree::dvec3& v, Numbers& out);

// Checks a length, which must be above 0 and at most kMaxCoordinate.
absl::StatusOr<double> read_length(const char* name, double length);

// Reads bounds: either 3 numbers each, where each `low` is less than its `high`, or none at all.
absl::StatusOr<std::optional<blobtree::Box>> read_bounds(const Numbers& low, const Numbers& high);

// Checks an iso value. For a positive field it must be within ]0, 1[, and 0.5 is the default. For a signed field its
// magnitude must be at most kMaxCoordinate, and 0 is the default.
absl::StatusOr<double> read_iso(std::optional<double> iso, operators::Law law);
template <class Request>
absl::StatusOr<double> read_iso(const Request& request, operators::Law law) {
  return read_iso(request.has_iso() ? std::optional(request.iso()) : std::nullopt, law);
}

// Returns the longest edge of the box of the supports, in model units. Returns nothing if the scene's operators do not
// bound its field, and 1 if the support is empty.
std::optional<double> longest_support_edge(const blobtree::Tape& tape);

// Checks that the inside of the scene is bounded, by its operators or by stated bounds. A signed field needs stated
// bounds if the iso value is above 0.
absl::Status check_bounded(const blobtree::Tape& tape, const std::optional<blobtree::Box>& bounds, double iso);

}  // namespace isofield::rpc
