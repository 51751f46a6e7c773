#include <absl/container/flat_hash_set.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "importers/formats.h"
#include "importers/import_options.h"
#include "importers/import_report.h"
#include "importers/swc_tree.h"
#include "importers/text.h"

namespace isofield {
namespace {

// Without ImportOptions::range_factor.
constexpr double kRangeFactor = 1;

double distance(const SwcSample& a, const SwcSample& b) {
  return std::hypot(a.center[0] - b.center[0], a.center[1] - b.center[1], a.center[2] - b.center[2]);
}

std::vector<SwcSample> read_samples(const std::string& text, ImportReport& report) {
  std::vector<SwcSample> samples;
  absl::flat_hash_set<long long> ids;
  LineReader lines(text);
  absl::string_view line;
  while (lines.next(line)) {
    if (line.empty() || line.front() == '#') continue;
    ++report.read;
    const auto fields = split_fields(line);
    const auto id = fields.size() < 7 ? std::nullopt : parse_integer(fields[0]);
    if (!id) {
      note(report, "line dropped: expected \"id type x y z radius parent\"", lines.number(), line);
      continue;
    }
    SwcSample sample;
    sample.id = *id;
    sample.type = parse_integer(fields[1]).value_or(0);
    sample.line_number = lines.number();
    sample.line = line;
    bool placed = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto coordinate = parse_length(fields[2 + axis]);
      placed = placed && coordinate;
      sample.center[axis] = coordinate.value_or(0);
    }
    if (!placed) {
      note(report, "sample dropped: a coordinate is not a finite number of a usable size", lines.number(), line);
      continue;
    }
    if (!ids.insert(sample.id).second) {
      note(report, "sample dropped: its id was used before", lines.number(), line);
      continue;
    }
    const auto parent = parse_integer(fields[6]);
    if (!parent) note(report, "sample made a root: its parent is not a whole number", lines.number(), line);
    sample.parent_id = parent.value_or(-1);
    sample.radius = parse_length(fields[5]).value_or(0);
    samples.push_back(sample);
  }
  return samples;
}

absl::Status mend_radii(std::vector<SwcSample>& samples, const ImportOptions& options, ImportReport& report) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SwcSample& sample : samples) {
    if (sample.radius > 0) smallest = std::min(smallest, sample.radius);
  }
  const double stand_in = options.min_radius.value_or(smallest);
  for (SwcSample& sample : samples) {
    if (sample.radius > 0) continue;
    if (std::isinf(stand_in)) {
      return absl::InvalidArgumentError("no sample has a radius > 0; state one to use instead (--min-radius)");
    }
    sample.radius = stand_in;
    note(report, absl::StrCat("radius not > 0 or not finite: ", stand_in, " used"), sample.line_number, sample.line);
  }
  return absl::OkStatus();
}

// Of each sample: whether it is one of the two outer samples of a soma of three, as public archives write a spherical
// soma: both at its radius from the root, with its radius.
std::vector<bool> find_soma_diameters(const std::vector<SwcSample>& samples) {
  constexpr double kTolerance = 0.05;
  std::vector<int> soma_children(samples.size(), 0);
  for (const SwcSample& sample : samples) {
    if (sample.type == kSomaType && sample.parent != kNoParent) ++soma_children[sample.parent];
  }
  const auto is_outer = [&](std::size_t i) {
    const SwcSample& sample = samples[i];
    if (sample.type != kSomaType || sample.parent == kNoParent || soma_children[i] != 0) return false;
    const SwcSample& root = samples[sample.parent];
    return root.type == kSomaType && root.parent == kNoParent && soma_children[sample.parent] == 2 &&
           std::abs(sample.radius - root.radius) <= kTolerance * root.radius &&
           std::abs(distance(sample, root) - root.radius) <= kTolerance * root.radius;
  };
  std::vector<int> outer_children(samples.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_outer(i)) ++outer_children[samples[i].parent];
  }
  std::vector<bool> found(samples.size(), false);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    found[i] = is_outer(i) && outer_children[samples[i].parent] == 2;
  }
  return found;
}

// Turns linked samples, parents first, into pieces.
class PieceMaker {
 public:
  PieceMaker(const std::vector<SwcSample>& samples, const ImportOptions& options, Imported& imported)
      : samples_(samples),
        options_(options),
        scene_(imported.scene),
        report_(imported.report),
        soma_diameter_(find_soma_diameters(samples)),
        tree_(samples.size()),
        edges_(samples.size(), 0),
        widest_(samples.size()),
        has_child_(samples.size(), false) {}

  void run(const std::vector<int>& order) {
    for (const int i : order) survey(i);
    for (const int i : order) make_piece(i);
  }

 private:
  bool has_edge(int i) const {
    if (samples_[i].parent == kNoParent || soma_diameter_[i]) return false;
    // Shorter ones vanish when rounded to float32.
    constexpr double kShortest = 1e-6;
    const SwcSample& parent = samples_[samples_[i].parent];
    return distance(samples_[i], parent) > kShortest * std::max(samples_[i].radius, parent.radius);
  }

  // Counts the edges of each tree, and finds its widest sample.
  void survey(int i) {
    const int parent = samples_[i].parent;
    tree_[i] = parent == kNoParent ? i : tree_[parent];
    if (parent == kNoParent) {
      widest_[i] = i;
    } else {
      has_child_[parent] = true;
      if (samples_[i].radius > samples_[widest_[tree_[i]]].radius) widest_[tree_[i]] = i;
    }
    if (has_edge(i)) ++edges_[tree_[i]];
  }

  void make_piece(int i) {
    const SwcSample& sample = samples_[i];
    if (sample.parent == kNoParent) {
      if (sample.type == kSomaType) {
        add_sphere(sample);
      } else if (edges_[i] == 0) {
        add_sphere(samples_[widest_[i]]);
      }
    } else if (soma_diameter_[i]) {
      note(report_, "sample left out: it only states the diameter of the soma", sample.line_number, sample.line, false);
    } else if (has_edge(i)) {
      add_segment(sample, samples_[sample.parent]);
    } else {
      drop_edge(i);
    }
  }

  // An edge of length 0. Its sample's place is covered by the parent's pieces, but for an end that is wider.
  void drop_edge(int i) {
    const SwcSample& sample = samples_[i];
    if (!has_child_[i] && edges_[tree_[i]] > 0 && sample.radius > samples_[sample.parent].radius) {
      add_sphere(sample);
      note(report_, "edge of length 0 made a sphere", sample.line_number, sample.line);
    } else {
      note(report_, "edge of length 0 dropped", sample.line_number, sample.line);
    }
  }

  void add_sphere(const SwcSample& sample) {
    v1::Node& node = *scene_.add_nodes();
    node.set_name(absl::StrCat("n", sample.id));
    v1::Sphere& sphere = *node.mutable_sphere();
    for (const double coordinate : sample.center) sphere.add_center(coordinate);
    sphere.set_radius(sample.radius);
    sphere.set_range(range_of(options_, kRangeFactor, sample.radius));
  }

  void add_segment(const SwcSample& sample, const SwcSample& parent) {
    const bool leaves_soma = parent.type == kSomaType && sample.type != kSomaType;
    const double parent_radius = leaves_soma ? sample.radius : parent.radius;
    v1::Node& node = *scene_.add_nodes();
    node.set_name(absl::StrCat("n", sample.id));
    v1::Segment& segment = *node.mutable_segment();
    for (const double coordinate : parent.center) segment.add_a(coordinate);
    for (const double coordinate : sample.center) segment.add_b(coordinate);
    segment.set_radius_a(parent_radius);
    segment.set_radius_b(sample.radius);
    segment.set_range(range_of(options_, kRangeFactor, std::max(parent_radius, sample.radius)));
  }

  const std::vector<SwcSample>& samples_;
  const ImportOptions& options_;
  v1::Scene& scene_;
  ImportReport& report_;
  const std::vector<bool> soma_diameter_;
  std::vector<int> tree_;        // of each sample: its root
  std::vector<int> edges_;       // of each root: edges that become segments
  std::vector<int> widest_;      // of each root: the sample with the largest radius
  std::vector<bool> has_child_;  // of each sample
};

}  // namespace

absl::Status import_swc(const std::string& text, const ImportOptions& options, Imported& imported) {
  imported.report.format = "neuron (SWC)";
  // By the rule of NeuroMorpho's archive; the format itself states none.
  imported.scene.set_unit("um");
  std::vector<SwcSample> samples = read_samples(text, imported.report);
  if (samples.empty()) return absl::InvalidArgumentError("no usable line \"id type x y z radius parent\"");
  if (auto status = mend_radii(samples, options, imported.report); !status.ok()) return status;
  link_parents(samples, imported.report);
  const auto roots =
      std::count_if(samples.begin(), samples.end(), [](const SwcSample& sample) { return sample.parent == kNoParent; });
  for (const SwcSample& sample : samples) {
    if (roots > 1 && sample.parent == kNoParent) {
      note(imported.report, "separate tree (the file has several roots)", sample.line_number, sample.line, false);
    }
  }
  PieceMaker(samples, options, imported).run(parents_first(samples));
  return absl::OkStatus();
}

}  // namespace isofield
