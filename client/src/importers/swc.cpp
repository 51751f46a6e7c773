#include <absl/strings/str_cat.h>

#include <algorithm>

#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/swc_pieces.h"
#include "importers/swc_radii.h"
#include "importers/swc_reader.h"
#include "importers/swc_scale.h"
#include "importers/swc_soma.h"
#include "importers/swc_tree.h"

namespace isofield {
namespace {

void note_trees(const std::vector<SwcSample>& samples, ImportReport& report) {
  const auto is_root = [](const SwcSample& sample) { return sample.parent == kNoParent; };
  if (std::count_if(samples.begin(), samples.end(), is_root) > 1) {
    for (const SwcSample& sample : samples) {
      if (is_root(sample)) {
        note(report, "separate tree (the file has several roots)", sample.line_number, sample.line, false);
      }
    }
  }
  if (std::none_of(samples.begin(), samples.end(), is_soma)) {
    note(report, "no soma: the file has no sample of type 1", samples.front().line_number, samples.front().line, false);
  }
}

// Notes a unit that is probably wrong. No soma has a radius above 100 um. A neuron that is nowhere thicker than 0.02 um
// would hardly be more than its membranes, which are 0.01 um thick.
void note_size(const std::vector<SwcSample>& samples, ImportReport& report) {
  constexpr double kLargest = 100, kSmallest = 0.02;
  const auto& widest = *std::max_element(samples.begin(), samples.end(),
                                         [](const SwcSample& a, const SwcSample& b) { return a.radius < b.radius; });
  if (widest.radius > kLargest) {
    note(report,
         absl::StrCat("the largest radius, ", widest.radius,
                      ", is implausible in micrometres: is the unit nm? The import option unit states it"),
         widest.line_number, widest.line, false);
  } else if (widest.radius > 0 && widest.radius < kSmallest) {
    note(report,
         absl::StrCat("the largest radius, ", widest.radius,
                      ", is implausible in micrometres: is the unit mm? The import option unit states it"),
         widest.line_number, widest.line, false);
  }
}

}  // namespace

absl::Status import_swc(const std::string& text, const ImportOptions& options, Imported& imported) {
  ImportReport& report = imported.report;
  report.format = "neuron (SWC)";
  // The archive NeuroMorpho.Org uses this unit; the format itself states none.
  imported.scene.set_unit("um");
  const glm::dvec3 scale = read_swc_scale(text, options.apply_scale, report);
  std::vector<SwcSample> samples = read_swc_samples(text, scale, report);
  if (samples.empty()) return absl::InvalidArgumentError("no usable line \"id type x y z radius parent\"");
  link_parents(samples, report);
  std::vector<int> order = parents_first(samples);
  note_trees(samples, report);
  const Somata somata = find_somata(order, samples, report);
  if (options.unit.empty()) note_size(samples, report);
  if (auto status = mend_radii(somata.outlines, options, order, samples, report); !status.ok()) return status;
  make_pieces(samples, order, somata, options, imported);
  return absl::OkStatus();
}

}  // namespace isofield
