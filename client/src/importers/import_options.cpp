#include "importers/import_options.h"

#include <absl/strings/str_cat.h>

#include <cmath>

namespace isofield {
namespace {

constexpr double kRicciExponent = 4;
constexpr double kBulgeStrength = 0.8;

absl::Status check_positive(const char* option, double value) {
  if (std::isfinite(value) && value > 0) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("import option ", option, ": ", value, "; expected a number > 0"));
}

template <typename Operator>
void add_children(int count, Operator& op) {
  op.mutable_children()->Reserve(count);
  for (int i = 0; i < count; ++i) op.add_children(absl::StrCat("#", i));
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
  return options.range.value_or(options.range_factor.value_or(factor) * radius);
}

void join_pieces(ImportOperator op, v1::Scene& scene) {
  const int count = scene.nodes_size();
  if (count < 2) return;
  v1::Node& model = *scene.add_nodes();
  model.set_name("model");
  switch (op) {
    case ImportOperator::kCamel:
      add_children(count, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CAMEL);
      break;
    case ImportOperator::kOrganic:
      add_children(count, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::ORGANIC);
      break;
    case ImportOperator::kContact:
      add_children(count, *model.mutable_gradient());
      model.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CONTACT);
      model.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
      model.mutable_gradient()->mutable_silhouette()->set_k(kBulgeStrength);
      break;
    case ImportOperator::kSum:
      add_children(count, *model.mutable_sum());
      break;
    case ImportOperator::kMax:
      add_children(count, *model.mutable_max());
      break;
    case ImportOperator::kRicci:
      add_children(count, *model.mutable_ricci());
      model.mutable_ricci()->set_exponent(kRicciExponent);
      break;
  }
  scene.set_root("model");
}

}  // namespace isofield
