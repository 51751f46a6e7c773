#include "importers/import_options.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "importers/text.h"

namespace isofield {
namespace {

constexpr double kRicciExponent = 4;
constexpr double kBulgeStrength = 0.8;

absl::Status check_positive(const char* option, double value) {
  if (value >= kLeastLength && value <= kLargestLength) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("import option ", option, ": ", value,
                                                 "; expected a number > 0, within [", kLeastLength, ", ",
                                                 kLargestLength, "]"));
}

template <typename Operator>
void add_children(const std::vector<int>& pieces, Operator& op) {
  op.mutable_children()->Reserve(static_cast<int>(pieces.size()));
  for (const int i : pieces) op.add_children(absl::StrCat("#", i));
}

}  // namespace

absl::Status check(const ImportOptions& options) {
  absl::Status status;
  if (options.range_factor) status.Update(check_positive("range_factor", *options.range_factor));
  if (options.range) status.Update(check_positive("range", *options.range));
  if (options.radius) status.Update(check_positive("radius", *options.radius));
  if (options.min_radius) status.Update(check_positive("min_radius", *options.min_radius));
  if (options.frame && *options.frame < 1) {
    status.Update(absl::InvalidArgumentError(
        absl::StrCat("import option frame: ", *options.frame, "; expected a place in the file, from 1")));
  }
  return status;
}

double range_of(const ImportOptions& options, double factor, double radius) {
  const double range = options.range.value_or(options.range_factor.value_or(factor) * radius);
  // The server multiplies this by the scale of the transform above it, which rounding may take above 1.
  return std::clamp(range, kLeastLength, kLargestLength * (1 - 1e-6));
}

std::vector<int> find_pieces(const v1::Scene& scene) {
  std::vector<int> pieces;
  for (int i = 0; i < scene.nodes_size(); ++i) {
    // An importer adds a transform right after the node that it places.
    if (scene.nodes(i).has_transform()) pieces.pop_back();
    pieces.push_back(i);
  }
  return pieces;
}

void join_pieces(ImportOperator op, v1::Scene& scene) {
  const std::vector<int> pieces = find_pieces(scene);
  if (pieces.size() < 2) return;
  v1::Node& model = *scene.add_nodes();
  model.set_name("model");
  switch (op) {
    case ImportOperator::kCamel:
      add_children(pieces, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CAMEL);
      break;
    case ImportOperator::kOrganic:
      add_children(pieces, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::ORGANIC);
      break;
    case ImportOperator::kContact:
      add_children(pieces, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CONTACT);
      model.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
      model.mutable_gradient()->mutable_silhouette()->set_k(kBulgeStrength);
      break;
    case ImportOperator::kSum:
      add_children(pieces, *model.mutable_sum());
      break;
    case ImportOperator::kMax:
      add_children(pieces, *model.mutable_max());
      break;
    case ImportOperator::kRicci:
      add_children(pieces, *model.mutable_ricci());
      model.mutable_ricci()->set_exponent(kRicciExponent);
      break;
  }
  scene.set_root("model");
}

}  // namespace isofield
