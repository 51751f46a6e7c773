// Places, lengths and iso values of requests, which several services read alike. All refuse with INVALID_ARGUMENT.
#pragma once

#include <absl/status/statusor.h>
#include <google/protobuf/repeated_field.h>

#include <optional>

#include "blobtree/tape/tape.h"

namespace isofield::rpc {

using Numbers = google::protobuf::RepeatedField<double>;

// 3 numbers of magnitude at most kMaxCoordinate.
absl::StatusOr<blobtree::dvec3> read_vector(const char* name, const Numbers& v);
void set_vector(const blobtree::dvec3& v, Numbers& out);

// Above 0, at most kMaxCoordinate.
absl::StatusOr<double> read_length(const char* name, double length);

// 3 numbers each, or none.
absl::StatusOr<std::optional<blobtree::Box>> read_bounds(const Numbers& low, const Numbers& high);

// Of a positive field within ]0, 1[, by default 0.5; of a signed one any, by default 0.
absl::StatusOr<double> read_iso(std::optional<double> iso, operators::Law law);
template <class Request>
absl::StatusOr<double> read_iso(const Request& request, operators::Law law) {
  return read_iso(request.has_iso() ? std::optional(request.iso()) : std::nullopt, law);
}

// Nothing where the scene's operators do not bound its field; 1 where there is none.
std::optional<double> longest_support_edge(const blobtree::Tape& tape);

// That what is inside is bounded, by the scene's operators or by stated bounds.
absl::Status check_bounded(const blobtree::Tape& tape, const std::optional<blobtree::Box>& bounds, double iso);

}  // namespace isofield::rpc
