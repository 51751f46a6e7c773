#include "importers/swc_radii.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <limits>

#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

// Returns, for each sample, the nearest one among itself and its descendants that has a radius; kNoParent where none
// has.
std::vector<int> nearest_with_radius(const std::vector<int>& order, const std::vector<bool>& outlines,
                                     const std::vector<SwcSample>& samples) {
  std::vector<int> nearest(samples.size(), kNoParent);
  std::vector<int> steps(samples.size(), std::numeric_limits<int>::max());
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    if (samples[*i].radius > 0 && !outlines[*i]) {
      nearest[*i] = *i;
      steps[*i] = 0;
    }
    const int parent = samples[*i].parent;
    if (parent == kNoParent || nearest[*i] == kNoParent) continue;
    const bool is_nearer =
        steps[*i] + 1 < steps[parent] || (steps[*i] + 1 == steps[parent] && nearest[*i] < nearest[parent]);
    if (is_nearer) {
      nearest[parent] = nearest[*i];
      steps[parent] = steps[*i] + 1;
    }
  }
  return nearest;
}

// Returns true for a root that the file states, and false for a sample that is a root because its parent is missing or
// dropped, or because a cycle is cut there.
bool begins_a_tree(const SwcSample& root) {
  return root.parent_id < 0 || root.parent_id == root.id;
}

}  // namespace

absl::Status mend_radii(const std::vector<bool>& outlines, const ImportOptions& options, std::vector<int>& order,
                        std::vector<SwcSample>& samples, ImportReport& report) {
  constexpr char kNone[] = "sample without a radius > 0 that a scene can hold: ";
  const std::vector<int> nearest = nearest_with_radius(order, outlines, samples);
  // These state for each sample whether its tree begins at a sample that has lost its parent, and whether it is
  // dropped.
  std::vector<bool> is_lost(samples.size(), false), is_dropped(samples.size(), false);
  for (const int i : order) {
    SwcSample& sample = samples[i];
    const int parent = sample.parent;
    const auto remark = [&](absl::string_view what, bool damage) {
      note(report, what, sample.line_number, sample.line, damage);
    };
    is_lost[i] = parent == kNoParent ? !begins_a_tree(sample) : is_lost[parent];
    is_dropped[i] = parent != kNoParent && is_dropped[parent];
    if (outlines[i]) continue;
    if (sample.radius > 0) {
      if (sample.radius < options.min_radius.value_or(0)) {
        sample.radius = *options.min_radius;
        remark("sample thinner than the import option min_radius: it gets that radius", false);
      }
    } else if (options.min_radius) {
      sample.radius = *options.min_radius;
      remark(absl::StrCat(kNone, "it gets the import option min_radius"), true);
    } else if (parent != kNoParent && samples[parent].radius > 0) {
      sample.radius = samples[parent].radius;
      remark(absl::StrCat(kNone, "it gets its parent's"), true);
    } else if (nearest[i] != kNoParent) {
      sample.radius = samples[nearest[i]].radius;
      remark(absl::StrCat(kNone, "no parent has one, it gets that of its nearest descendant that has one"), true);
    } else if (is_lost[i]) {
      is_dropped[i] = true;
      remark(
          "sample dropped: its tree has lost its parent and has no radius > 0; the import option min_radius gives it "
          "one",
          true);
    } else {
      return absl::InvalidArgumentError(absl::StrCat(
          quote_line(sample.line_number, sample.line), ": neither this first sample of a tree nor one that follows it ",
          "has a radius > 0; expected one, or a radius to use in its place (import option min_radius)"));
    }
  }
  order.erase(std::remove_if(order.begin(), order.end(), [&](int i) { return is_dropped[i]; }), order.end());
  return absl::OkStatus();
}

}  // namespace isofield
