#include "rpc/evaluate_grid.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "base/status_macros.h"
#include "engine/mesh/mesh_lattice.h"
#include "rpc/geometry_arguments.h"
#include "rpc/grid_parts.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

// A grid is evaluated in steps of this many points, or of more if its layers are larger; the results of a step take 1
// to 4 MiB. A message holds as many points if the client accepts it.
constexpr std::uint64_t kGridSlab = 1u << 18;

}  // namespace

absl::StatusOr<blobtree::Lattice> read_lattice(const v1::EvaluateGridRequest& request, const Limits& limits) {
  blobtree::Lattice lattice;
  ISOFIELD_ASSIGN_OR_RETURN(lattice.origin, read_vector("origin", request.origin()));
  google::protobuf::RepeatedField<double> spacing = request.spacing();
  if (spacing.size() == 1) {
    const double same = spacing[0];
    spacing.Resize(3, same);
  }
  ISOFIELD_ASSIGN_OR_RETURN(lattice.spacing, read_vector("spacing", spacing));
  for (int i = 0; i < 3; ++i) {
    if (!(spacing[i] > 0)) {
      return absl::InvalidArgumentError(absl::StrCat("spacing[", i, "] = ", spacing[i], ": expected a number > 0"));
    }
  }
  if (request.counts_size() != 3) {
    return absl::InvalidArgumentError(absl::StrCat("counts holds ", request.counts_size(), " numbers: expected 3"));
  }
  unsigned __int128 points = 1;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t count = request.counts(i);
    if (count < 1 || count > engine::kMaxCellsPerAxis) {
      return absl::InvalidArgumentError(
          absl::StrCat("counts[", i, "] = ", count, ": expected a count within [1, ", engine::kMaxCellsPerAxis, "]"));
    }
    lattice.cells[i] = static_cast<std::uint32_t>(count);
    points *= count;
  }
  if (points > limits.max_grid_points) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the grid has more points than the ", limits.max_grid_points, " admitted"));
  }
  const std::uint64_t layer = std::uint64_t{lattice.cells[0]} * lattice.cells[1];
  if (layer > limits.max_points_per_message) {
    return absl::ResourceExhaustedError(absl::StrCat("a layer of the grid has ", layer, " points, at most ",
                                                     limits.max_points_per_message,
                                                     " are admitted: ask for parts of it"));
  }
  return lattice;
}

std::uint64_t points_of_lattice(const blobtree::Lattice& lattice) {
  return std::uint64_t{lattice.cells[0]} * lattice.cells[1] * lattice.cells[2];
}

GridEvaluation::GridEvaluation(engine::FieldEvaluator& fields, const engine::ResidentScene& scene,
                               const blobtree::Lattice& lattice, engine::ResultLayout layout, std::uint64_t most,
                               const Call& call, Writer& writer)
    : fields_(fields),
      scene_(scene),
      lattice_(lattice),
      layout_(layout),
      width_(static_cast<std::uint32_t>(layout.numbers())),
      layer_(std::uint64_t{lattice.cells[0]} * lattice.cells[1]),
      most_(most),
      cancelled_(call.cancelled()),
      writer_(writer) {}

absl::Status GridEvaluation::run() {
  const std::uint32_t all = lattice_.cells[2];
  // Each step evaluates whole layers of bricks, at least one.
  const std::uint64_t bricks = std::max<std::uint64_t>(std::min(most_, kGridSlab) / layer_ / blobtree::kBrickCells, 1);
  const auto step = static_cast<std::uint32_t>(std::min<std::uint64_t>(bricks * blobtree::kBrickCells, all + 3));
  for (std::uint32_t k = 0; k < all; k += step) {
    if (cancelled_()) return client_gone();
    const std::uint32_t layers = std::min(step, all - k);
    ISOFIELD_RETURN_IF_ERROR(layers * layer_ <= most_ ? send_at_once(k, layers) : send_in_parts(k, layers));
  }
  return absl::OkStatus();
}

absl::Status GridEvaluation::send_at_once(std::uint32_t first, std::uint32_t layers) {
  response_.Clear();
  response_.set_first_layer(first);
  const std::span<float> out =
      make_float_tensor({layers, lattice_.cells[1], lattice_.cells[0], width_}, *response_.mutable_result());
  ISOFIELD_RETURN_IF_ERROR(fields_.evaluate_layers(scene_, lattice_, first, layout_, out, cancelled_));
  return send(writer_, response_);
}

absl::Status GridEvaluation::send_in_parts(std::uint32_t first, std::uint32_t layers) {
  several_.resize(layers * layer_ * width_);
  ISOFIELD_RETURN_IF_ERROR(fields_.evaluate_layers(scene_, lattice_, first, layout_, std::span(several_), cancelled_));
  auto from = several_.begin();
  for (const GridPart& part : grid_parts({lattice_.cells[0], lattice_.cells[1], layers}, most_)) {
    response_.Clear();
    response_.set_first_layer(first + part.first[2]);
    response_.set_first_row(part.first[1]);
    response_.set_first_column(part.first[0]);
    const auto [columns, rows, whole] = part.counts;
    const std::span<float> out = make_float_tensor({whole, rows, columns, width_}, *response_.mutable_result());
    std::copy_n(from, out.size(), out.begin());
    from += static_cast<std::ptrdiff_t>(out.size());
    ISOFIELD_RETURN_IF_ERROR(send(writer_, response_));
  }
  return absl::OkStatus();
}

}  // namespace isofield::rpc
