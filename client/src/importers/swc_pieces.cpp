#include "importers/swc_pieces.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "importers/import_options.h"
#include "importers/import_report.h"
#include "importers/swc_body.h"

namespace isofield {
namespace {

struct End {
  glm::dvec3 center;
  double radius;
};

End end_of(const SwcSample& sample) {
  return {sample.center, sample.radius};
}

bool has_length(const End& a, const End& b) {
  // Shorter edges vanish when rounded to float32.
  constexpr double kShortest = 1e-6;
  return glm::distance(a.center, b.center) > kShortest * std::max(a.radius, b.radius);
}

// Makes the pieces of all trees: it surveys all samples first, then makes the piece of each.
class PieceMaker {
 public:
  PieceMaker(const std::vector<SwcSample>& samples, const Somata& somata, const ImportOptions& options,
             Imported& imported)
      : samples_(samples),
        somata_(somata),
        options_(options),
        scene_(imported.scene),
        report_(imported.report),
        tree_(samples.size()),
        edges_(samples.size(), 0),
        widest_(samples.size()),
        has_child_(samples.size(), false),
        within_(samples.size(), kNoParent) {}

  void run(const std::vector<int>& order) {
    for (const int i : order) survey(i);
    for (const int i : order) make_piece(i);
  }

 private:
  bool in_soma(int i) const { return somata_.soma_of[i] != kNoSoma; }
  const Soma& soma_of(int i) const { return somata_.all[somata_.soma_of[i]]; }

  // Counts the edges of each tree that have a length, and finds its widest sample. A soma counts as an edge, unless it
  // is a stack of frusta, whose own edges count.
  void survey(int i) {
    const int parent = samples_[i].parent;
    tree_[i] = parent == kNoParent ? i : tree_[parent];
    const bool has_body = in_soma(i) && soma_of(i).form != SomaForm::kFrusta;
    if (parent == kNoParent) {
      widest_[i] = i;
    } else {
      has_child_[parent] = true;
      if (samples_[i].radius > samples_[widest_[tree_[i]]].radius) widest_[tree_[i]] = i;
    }
    if (has_body || (parent != kNoParent && has_length(end_of(samples_[i]), end_of(samples_[parent])))) {
      ++edges_[tree_[i]];
    }
  }

  void make_piece(int i) {
    const int parent = samples_[i].parent;
    if (in_soma(i)) {
      const Soma& soma = soma_of(i);
      if (soma.form != SomaForm::kFrusta && soma.members.front() == i) add_soma(soma, samples_, options_, scene_);
      if (parent != kNoParent && !in_soma(parent)) return enter_soma(i);
      if (soma.form != SomaForm::kFrusta) return;
    } else if (parent != kNoParent && (in_soma(parent) || within_[parent] != kNoParent)) {
      return leave_soma(i);
    }
    if (parent == kNoParent) {
      if (edges_[i] == 0) add_sphere(samples_[widest_[i]], options_, scene_);
    } else {
      add_edge(i, end_of(samples_[parent]), end_of(samples_[i]));
    }
  }

  // Ends a process that leads from its parent to a soma at the surface of the soma.
  void enter_soma(int i) {
    const SwcSample& parent = samples_[samples_[i].parent];
    const Joint joint = join_soma(somata_, i, parent.center, samples_);
    const std::string name = absl::StrCat(piece_name(samples_[i]), soma_of(i).form == SomaForm::kFrusta ? "" : "/edge");
    if (!joint.contains(parent.center)) {
      add_segment(name, end_of(parent), {joint.surface(joint.target, parent.center), parent.radius});
    } else if (parent.radius > joint.width && glm::distance(parent.center, joint.target) > 0) {
      add_segment(name, end_of(parent), {joint.target, parent.radius});
    } else {
      note_within(samples_[i]);
    }
  }

  // Begins a process at the surface of its soma. Samples inside are left out unless they are thicker than the soma.
  void leave_soma(int i) {
    const SwcSample& sample = samples_[i];
    const int parent = sample.parent;
    const bool is_first = in_soma(parent);
    const int at = is_first ? parent : within_[parent];
    const Joint joint = join_soma(somata_, at, sample.center, samples_);
    const glm::dvec3 inner = is_first ? joint.target : samples_[parent].center;
    const double inner_radius = is_first ? sample.radius : samples_[parent].radius;
    const bool ends_inside = joint.contains(sample.center);
    if (ends_inside && sample.radius <= joint.width) {
      within_[i] = at;
      if (has_child_[i] || is_covered(joint, end_of(sample))) return note_within(sample);
    }
    const glm::dvec3 start = ends_inside ? inner : joint.surface(inner, sample.center);
    const double whole = glm::distance(inner, sample.center);
    const double part = whole > 0 ? glm::distance(inner, start) / whole : 0;
    add_edge(i, {start, inner_radius + part * (sample.radius - inner_radius)}, end_of(sample));
  }

  // Returns true where the joint also contains the point of the ball of the sample that is farthest from the target.
  static bool is_covered(const Joint& joint, const End& end) {
    const double out = glm::distance(joint.target, end.center);
    return !(out > 0) || joint.contains(joint.target + (1 + end.radius / out) * (end.center - joint.target));
  }

  void note_within(const SwcSample& sample) {
    note(report_, "edge within the soma left out: the process begins at the soma's surface", sample.line_number,
         sample.line, false);
  }

  // Adds a segment. An edge without a length is left out, since the parent's pieces cover its place; but an end that is
  // wider than its parent becomes a sphere.
  void add_edge(int i, const End& from, const End& to) {
    const SwcSample& sample = samples_[i];
    if (has_length(from, to)) return add_segment(piece_name(sample), from, to);
    if (!has_child_[i] && edges_[tree_[i]] > 0 && sample.radius > samples_[sample.parent].radius) {
      add_sphere(sample, options_, scene_);
      note(report_, "edge of length 0 made a sphere", sample.line_number, sample.line);
    } else {
      note(report_, "edge of length 0 dropped", sample.line_number, sample.line);
    }
  }

  void add_segment(const std::string& name, const End& from, const End& to) {
    v1::Node& node = *scene_.add_nodes();
    node.set_name(name);
    v1::Segment& segment = *node.mutable_segment();
    for (int axis = 0; axis < 3; ++axis) {
      segment.add_a(from.center[axis]);
      segment.add_b(to.center[axis]);
    }
    segment.set_radius_a(from.radius);
    segment.set_radius_b(to.radius);
    segment.set_range(range_of(options_, kSwcRangeFactor, std::max(from.radius, to.radius)));
  }

  const std::vector<SwcSample>& samples_;
  const Somata& somata_;
  const ImportOptions& options_;
  v1::Scene& scene_;
  ImportReport& report_;
  std::vector<int> tree_;        // the root of each sample
  std::vector<int> edges_;       // the number of edges and bodies that become pieces, for each root
  std::vector<int> widest_;      // the sample with the largest radius, for each root
  std::vector<bool> has_child_;  // true for each sample that is the parent of another one
  // The sample of the soma that a process is linked to, for each sample of the process inside of the soma; else
  // kNoParent.
  std::vector<int> within_;
};

}  // namespace

void make_pieces(const std::vector<SwcSample>& samples, const std::vector<int>& order, const Somata& somata,
                 const ImportOptions& options, Imported& imported) {
  PieceMaker(samples, somata, options, imported).run(order);
}

void add_sphere(const SwcSample& sample, const ImportOptions& options, v1::Scene& scene) {
  v1::Node& node = *scene.add_nodes();
  node.set_name(piece_name(sample));
  v1::Sphere& sphere = *node.mutable_sphere();
  for (int axis = 0; axis < 3; ++axis) sphere.add_center(sample.center[axis]);
  sphere.set_radius(sample.radius);
  sphere.set_range(range_of(options, kSwcRangeFactor, sample.radius));
}

}  // namespace isofield
