#include "scenes/opening_pick.h"

#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/limits.h"
#include "base/quoted.h"
#include "base/status_macros.h"
#include "blobtree/scene/node_reader.h"

namespace isofield::scenes {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Returns the index of the node that a name, or "#index", refers to; nothing if there is no such node.
std::optional<int> find_node(const v1::Scene& scene, const std::string& reference) {
  if (!reference.empty() && reference[0] == '#') {
    int index = 0;
    const bool is_index = std::all_of(reference.begin() + 1, reference.end(), absl::ascii_isdigit) &&
                          absl::SimpleAtoi(reference.substr(1), &index) && index < scene.nodes_size();
    return is_index ? std::optional(index) : std::nullopt;
  }
  for (int i = 0; i < scene.nodes_size() && !reference.empty(); ++i) {
    if (scene.nodes(i).name() == reference) return i;
  }
  return std::nullopt;
}

struct Sample {
  operators::Law law = operators::Law::kPositive;
  double f = 0;
  std::array<double, 3> gradient{};
};

// Evaluates the field of a node at a point of the node's own frame.
absl::StatusOr<Sample> sample(const FoundScene& found, const std::string& node, const blobtree::dvec3& point,
                              engine::Engine& engine) {
  v1::Scene rooted = *found.scene;
  rooted.set_root(node);
  ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease scene, engine.make_resident(rooted, found.operators->table));
  const std::array<float, 3> xyz{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
  constexpr engine::ResultLayout kLayout = engine::ResultLayout::kValueAndGradient;
  std::array<float, kLayout.numbers()> out{};
  ISOFIELD_RETURN_IF_ERROR(engine.fields().evaluate(*scene, xyz, kLayout, out));
  const engine::ResultRows row(kLayout, out);
  const auto [gx, gy, gz] = row.gradient(0);
  return Sample{scene->tape().law, row.value(0), {gx, gy, gz}};
}

// Returns the angle in radians; it is 0 if one of the vectors is null.
double angle_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const std::array<double, 3> cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return std::atan2(std::hypot(cross[0], cross[1], cross[2]), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

}  // namespace

absl::StatusOr<OpeningPick> pick_opening(const FoundScene& found, const std::string& node, const blobtree::dvec3& point,
                                         engine::Engine& engine) {
  const std::string name = base::quoted(node);
  const std::optional<int> index = find_node(*found.scene, node);
  if (!index) {
    return absl::InvalidArgumentError(absl::StrCat("node = ", name, " is no node: expected a node's name, or #0 to #",
                                                   found.scene->nodes_size() - 1));
  }
  const auto children = blobtree::child_references(found.scene->nodes(*index));
  if (children.size() != 2) {
    return absl::InvalidArgumentError(
        absl::StrCat("node = ", name, " has ", children.size(), " children: expected a positive operator of 2"));
  }
  ISOFIELD_ASSIGN_OR_RETURN(const Sample first, sample(found, *children[0], point, engine));
  ISOFIELD_ASSIGN_OR_RETURN(const Sample second, sample(found, *children[1], point, engine));
  // An operator of two children has the same law as its children; otherwise the scene would have been refused above.
  if (first.law != operators::Law::kPositive) {
    return absl::InvalidArgumentError(
        absl::StrCat("node = ", name, " joins signed fields: expected a positive operator of 2 children"));
  }
  if (!(first.f > 0)) {
    return absl::InvalidArgumentError(absl::StrCat("point = (", point.x, ", ", point.y, ", ", point.z,
                                                   "): the first child's field is 0 there; expected "
                                                   "a point of its surface"));
  }
  return OpeningPick{.theta = std::min(std::atan2(second.f, first.f) * kDegrees, 45.0),
                     .alpha = angle_between(first.gradient, second.gradient) * kDegrees,
                     .f1 = first.f,
                     .f2 = second.f};
}

}  // namespace isofield::scenes
