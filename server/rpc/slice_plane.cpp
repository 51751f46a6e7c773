#include "rpc/slice_plane.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/limits.h"
#include "base/status_macros.h"
#include "blobtree/scene/scene.h"
#include "rpc/geometry_arguments.h"

namespace isofield::rpc {
namespace {

using blobtree::dvec3;

// The number of samples along the longer extent if neither counts nor spacing is stated.
constexpr double kDefaultCount = 512;

absl::StatusOr<dvec3> read_axis(const char* name, const Numbers& numbers, const dvec3& otherwise) {
  if (numbers.empty()) return otherwise;
  ISOFIELD_ASSIGN_OR_RETURN(const dvec3 axis, read_vector(name, numbers));
  if (!(length(axis) >= base::kMinLength)) {
    return absl::InvalidArgumentError(absl::StrCat(name, " = (", axis.x, ", ", axis.y, ", ", axis.z,
                                                   "): expected a length of at least ", base::kMinLength));
  }
  return axis;
}

absl::Status read_axes(const v1::SliceRequest& request, engine::Plane& plane) {
  ISOFIELD_ASSIGN_OR_RETURN(const dvec3 u, read_axis("u", request.u(), {1, 0, 0}));
  ISOFIELD_ASSIGN_OR_RETURN(const dvec3 v, read_axis("v", request.v(), {0, 1, 0}));
  plane.u = u * (1 / length(u));
  const dvec3 unit = v * (1 / length(v));
  const dvec3 rest = unit - plane.u * dot(plane.u, unit);
  if (!(length(rest) >= 1e-6)) {
    return absl::InvalidArgumentError(
        absl::StrCat("v = (", v.x, ", ", v.y, ", ", v.z, "): expected a direction that is not parallel to u"));
  }
  plane.v = rest * (1 / length(rest));
  return absl::OkStatus();
}

// Returns the extents of the box of the supports along the plane's axes.
std::array<double, 2> extents_of(const blobtree::Box& box, const engine::Plane& plane) {
  const dvec3 edges = box.max - box.min;
  const auto along = [&](const dvec3& axis) {
    return std::abs(axis.x) * edges.x + std::abs(axis.y) * edges.y + std::abs(axis.z) * edges.z;
  };
  return {along(plane.u), along(plane.v)};
}

absl::Status read_counts(const v1::SliceRequest& request, std::array<double, 2>& counts) {
  if (request.counts_size() != 2) {
    return absl::InvalidArgumentError(absl::StrCat("counts holds ", request.counts_size(), " numbers: expected 2"));
  }
  for (int i = 0; i < 2; ++i) {
    if (request.counts(i) < 1) {
      return absl::InvalidArgumentError(absl::StrCat("counts[", i, "] = 0: expected a count of at least 1"));
    }
    counts[i] = static_cast<double>(request.counts(i));
  }
  return absl::OkStatus();
}

absl::Status read_spacing(const v1::SliceRequest& request, std::array<double, 2>& spacing) {
  const int size = request.spacing_size();
  if (size != 1 && size != 2) {
    return absl::InvalidArgumentError(absl::StrCat("spacing holds ", size, " numbers: expected 1 or 2"));
  }
  for (int i = 0; i < 2; ++i) {
    ISOFIELD_ASSIGN_OR_RETURN(spacing[i], read_length("spacing", request.spacing(i % size)));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<engine::Plane> read_plane(const v1::SliceRequest& request, const blobtree::Tape& tape,
                                         std::uint64_t max_points) {
  const bool is_whole = !request.origin().empty() && !request.spacing().empty() && !request.counts().empty();
  if (!is_whole && !longest_support_edge(tape)) {
    return absl::InvalidArgumentError(
        "origin, spacing and counts: expected, since the operators of this scene do not bound its field by themselves");
  }
  // A scene without any field is sampled around the origin.
  const blobtree::Box box = tape.support.empty() ? blobtree::Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}} : tape.support;
  engine::Plane plane;
  ISOFIELD_RETURN_IF_ERROR(read_axes(request, plane));
  const std::array<double, 2> extents = extents_of(box, plane);
  std::array<double, 2> counts{}, spacing{};
  if (!request.counts().empty()) ISOFIELD_RETURN_IF_ERROR(read_counts(request, counts));
  if (!request.spacing().empty()) {
    ISOFIELD_RETURN_IF_ERROR(read_spacing(request, spacing));
  } else if (!request.counts().empty()) {
    for (int i = 0; i < 2; ++i) spacing[i] = extents[i] / std::max(counts[i] - 1, 1.0);
  } else {
    spacing.fill(std::max(extents[0], extents[1]) / (kDefaultCount - 1));
  }
  if (request.counts().empty()) {
    // There is one more sample than there are steps. Supports are rounded outwards by about 1e-5 of their size, which
    // must not add another sample.
    for (int i = 0; i < 2; ++i) counts[i] = std::ceil(extents[i] / spacing[i] * (1 - 1e-4)) + 1;
  }
  if (!(counts[0] * counts[1] <= static_cast<double>(max_points))) {
    return absl::ResourceExhaustedError(absl::StrCat("counts = [", counts[0], ", ", counts[1], "]: at most ",
                                                     max_points, " points are admitted; ask for parts of it"));
  }
  for (int i = 0; i < 2; ++i) {
    plane.counts[i] = static_cast<std::uint32_t>(counts[i]);
    plane.spacing[i] = spacing[i];
    if (!(counts[i] * spacing[i] <= base::kMaxCoordinate)) {
      return absl::InvalidArgumentError(
          absl::StrCat("spacing = ", spacing[i], ": expected a plane of a length of at most ", base::kMaxCoordinate));
    }
  }
  if (!request.origin().empty()) {
    ISOFIELD_ASSIGN_OR_RETURN(plane.origin, read_vector("origin", request.origin()));
  } else {
    plane.origin = (box.min + box.max) * 0.5 - plane.u * ((counts[0] - 1) * spacing[0] / 2) -
                   plane.v * ((counts[1] - 1) * spacing[1] / 2);
  }
  return plane;
}

}  // namespace isofield::rpc
