#include "importers/swc_radii.h"

#include <absl/strings/str_cat.h>

#include <limits>

#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

// The nearest descendant with a radius of each sample, itself included; kNoParent where there is none.
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
    const bool is_nearer = steps[*i] + 1 < steps[parent] ||
                           (steps[*i] + 1 == steps[parent] && nearest[*i] < nearest[parent]);
    if (is_nearer) {
      nearest[parent] = nearest[*i];
      steps[parent] = steps[*i] + 1;
    }
  }
  return nearest;
}

}  // namespace

absl::Status mend_radii(const std::vector<int>& order, const std::vector<bool>& outlines, const ImportOptions& options,
                        std::vector<SwcSample>& samples, ImportReport& report) {
  constexpr char kNone[] = "sample without a radius > 0 that a scene can hold: ";
  const std::vector<int> nearest = nearest_with_radius(order, outlines, samples);
  for (const int i : order) {
    SwcSample& sample = samples[i];
    if (outlines[i]) continue;
    if (sample.radius > 0) {
      if (sample.radius < options.min_radius.value_or(0)) {
        sample.radius = *options.min_radius;
        note(report, "sample thinner than --min-radius: it gets that radius", sample.line_number, sample.line, false);
      }
      continue;
    }
    // Outlines without a radius have none to hand on.
    const bool has_parent = sample.parent != kNoParent && samples[sample.parent].radius > 0;
    if (options.min_radius) {
      sample.radius = *options.min_radius;
      note(report, absl::StrCat(kNone, "it gets --min-radius"), sample.line_number, sample.line);
    } else if (has_parent) {
      sample.radius = samples[sample.parent].radius;
      note(report, absl::StrCat(kNone, "it gets its parent's"), sample.line_number, sample.line);
    } else if (nearest[i] != kNoParent) {
      sample.radius = samples[nearest[i]].radius;
      note(report, absl::StrCat(kNone, "a first sample, it gets that of its nearest descendant that has one"),
           sample.line_number, sample.line);
    } else {
      return absl::InvalidArgumentError(absl::StrCat(
          quote_line(sample.line_number, sample.line), ": neither this first sample of a tree nor one that follows it ",
          "has a radius > 0; expected one, or a radius to use in its place (--min-radius)"));
    }
  }
  return absl::OkStatus();
}

}  // namespace isofield
