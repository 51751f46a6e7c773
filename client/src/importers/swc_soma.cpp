#include "importers/swc_soma.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "importers/import_report.h"

namespace isofield {
namespace {

// Groups the samples of type 1 into somata, decides their forms, and joins outlines at several depths.
class SomaFinder {
 public:
  SomaFinder(const std::vector<int>& order, std::vector<SwcSample>& samples, ImportReport& report)
      : samples_(samples), report_(report), soma_children_(samples.size(), 0) {
    found_.soma_of.assign(samples.size(), kNoSoma);
    found_.first_child.assign(samples.size(), kNoParent);
    found_.outlines.assign(samples.size(), false);
    for (const int i : order) {
      if (!is_soma(samples[i])) continue;
      const int parent = samples[i].parent;
      const bool continues = parent != kNoParent && is_soma(samples[parent]);
      if (!continues) found_.all.emplace_back();
      found_.soma_of[i] = continues ? found_.soma_of[parent] : static_cast<int>(found_.all.size()) - 1;
      found_.all[found_.soma_of[i]].members.push_back(i);
      if (continues && soma_children_[parent]++ == 0) found_.first_child[parent] = i;
    }
  }

  Somata run() {
    for (Soma& soma : found_.all) decide(soma);
    join_outlines();
    for (const Soma& soma : found_.all) {
      if (!soma.members.empty()) tell(soma);
    }
    return std::move(found_);
  }

 private:
  void decide(Soma& soma) {
    if (is_at_one_place(soma) || (soma.members.size() == 3 && is_sphere_of_three(soma))) {
      soma.form = SomaForm::kSphere;
    } else if (is_outline(soma)) {
      soma.form = SomaForm::kContours;
      for (const int i : soma.members) found_.outlines[i] = true;
    } else {
      soma.form = SomaForm::kFrusta;
    }
  }

  // Returns true for samples so near each other that no edge between them has a length. The first one gets the largest
  // radius.
  bool is_at_one_place(const Soma& soma) {
    SwcSample& first = samples_[soma.members.front()];
    double radius = 0, extent = 0;
    for (const int i : soma.members) {
      radius = std::max(radius, samples_[i].radius);
      extent = std::max(extent, glm::distance(samples_[i].center, first.center));
    }
    if (extent > 1e-6 * radius) return false;
    first.radius = radius;
    return true;
  }

  // Returns true where the second and the third sample are opposite each other about the first, their parent. Each
  // radius must be equal to the distance of these from the first, or state nothing (0, or as thin as an outline).
  bool is_sphere_of_three(const Soma& soma) {
    constexpr double kTolerance = 0.05;
    const int center = soma.members[0];
    if (soma_children_[center] != 2) return false;
    const glm::dvec3 middle = samples_[center].center;
    const glm::dvec3 first = samples_[soma.members[1]].center - middle;
    const glm::dvec3 second = samples_[soma.members[2]].center - middle;
    const double radius = (glm::length(first) + glm::length(second)) / 2;
    if (!(glm::length(first + second) <= 2 * kTolerance * radius) || radius < kLeast || radius > kMost) return false;
    const auto fits = [&](int i) {
      const double stated = samples_[i].radius;
      return stated <= kThin * radius || std::abs(stated - radius) <= kTolerance * radius;
    };
    if (!std::all_of(soma.members.begin(), soma.members.end(), fits)) return false;
    if (samples_[center].radius <= kThin * radius) samples_[center].radius = radius;
    for (const int i : {soma.members[1], soma.members[2]}) {
      found_.outlines[i] = true;
      samples_[i].radius = samples_[center].radius;
    }
    return true;
  }

  bool is_outline(Soma& soma) const {
    std::vector<int> outer = soma.members;
    // The centre of a star, or a first sample in the middle of the others, is no part of the outline.
    const bool is_star = soma_children_[outer.front()] >= 3;
    if (is_star || is_in_the_middle(soma)) outer.erase(outer.begin());
    const bool branches = std::any_of(outer.begin(), outer.end(), [&](int i) { return soma_children_[i] > 1; });
    std::vector<glm::dvec3> points;
    for (const int i : outer) points.push_back(samples_[i].center);
    for (const bool in_order : {true, false}) {
      if (in_order ? is_star : !is_star && !branches) continue;
      auto contours = fit_contours(points, in_order);
      if (const auto contour = fit_contour(points, in_order)) contours = {*contour};
      const bool are_thin = std::all_of(contours.begin(), contours.end(), [&](const Contour& contour) {
        return median_radius(outer) <= kThin * std::sqrt(contour.major_length * contour.minor_length) &&
               contour.minor_length >= kLeast && contour.major_length <= kMost;
      });
      if (contours.empty() || !are_thin) continue;
      // The normal of a single contour points to the side from which pictures are seen by default.
      if (contours.size() == 1) face({1e-6, 1e-3, 1}, contours.front());
      for (Contour& contour : contours) contour.first_point = outer[contour.first_point];
      soma.contours = std::move(contours);
      return true;
    }
    return false;
  }

  bool is_in_the_middle(const Soma& soma) const {
    const glm::dvec3 first = samples_[soma.members.front()].center;
    const double others = static_cast<double>(soma.members.size()) - 1;
    glm::dvec3 middle{};
    for (const int i : soma.members) middle += 1 / others * (samples_[i].center - first);
    double extent = 0;
    for (const int i : soma.members) extent += glm::distance(samples_[i].center, first) / others;
    return soma.members.size() > 3 && glm::length(middle) <= 0.3 * extent;
  }

  double median_radius(const std::vector<int>& members) const {
    std::vector<double> radii;
    for (const int i : members) radii.push_back(samples_[i].radius);
    std::nth_element(radii.begin(), radii.begin() + radii.size() / 2, radii.end());
    return radii[radii.size() / 2];
  }

  // Outlines at several depths may be trees of their own. Each one joins the outline before it in the file where the
  // two lie above each other, no farther apart than the body is wide.
  void join_outlines() {
    Soma* open = nullptr;
    for (Soma& soma : found_.all) {
      if (soma.form != SomaForm::kContours) continue;
      if (open == nullptr || !lies_above(open->contours.back(), soma.contours.front())) {
        open = &soma;
        continue;
      }
      for (Contour& contour : soma.contours) {
        face(open->contours.front().normal, contour);
        open->contours.push_back(contour);
      }
      for (const int i : soma.members) found_.soma_of[i] = static_cast<int>(open - found_.all.data());
      open->members.insert(open->members.end(), soma.members.begin(), soma.members.end());
      soma.members.clear();
      soma.contours.clear();
    }
    for (Soma& soma : found_.all) {
      if (soma.contours.size() < 2) continue;
      const glm::dvec3 normal = soma.contours.front().normal;
      std::stable_sort(soma.contours.begin(), soma.contours.end(), [&](const Contour& a, const Contour& b) {
        return glm::dot(normal, a.center) < glm::dot(normal, b.center);
      });
      // Two outlines at one depth may be those of a cell and its nucleus; only the first one is kept.
      const auto is_same_depth = [&](const Contour& a, const Contour& b) {
        return glm::dot(normal, b.center - a.center) <= 1e-3 * std::min(a.minor_length, b.minor_length);
      };
      soma.contours.erase(std::unique(soma.contours.begin(), soma.contours.end(), is_same_depth), soma.contours.end());
      if (soma.contours.size() > 1) soma.stack = stack_contours(soma.contours);
    }
  }

  static bool lies_above(const Contour& below, const Contour& above) {
    const double width = std::min(below.major_length, above.major_length);
    const glm::dvec3 step = above.center - below.center;
    const double depth = std::abs(glm::dot(step, below.normal));
    const double aside = std::sqrt(std::max(0.0, glm::dot(step, step) - depth * depth));
    return std::abs(glm::dot(below.normal, above.normal)) > 0.99 && aside < width && depth > 1e-3 * width &&
           depth < 2 * width;
  }

  void tell(const Soma& soma) {
    const SwcSample& first = samples_[soma.members.front()];
    const auto remark = [&](const char* what) { note(report_, what, first.line_number, first.line, false); };
    switch (soma.form) {
      case SomaForm::kSphere:
        if (soma.members.size() == 1) return remark("soma of one sample: made a sphere");
        if (!found_.outlines[soma.members[1]]) return remark("soma of samples at one place: made a sphere");
        remark("soma of three samples, as NeuroMorpho writes it: made a sphere of the same area");
        for (const int i : {soma.members[1], soma.members[2]}) {
          note(report_, "sample left out: it only states the diameter of the soma", samples_[i].line_number,
               samples_[i].line, false);
        }
        return;
      case SomaForm::kContours:
        return remark(
            soma.contours.size() == 1
                ? "soma outlined by a contour: made an ellipsoid, whose third axis is the mean of the two"
                : "soma outlined by contours at several depths: made the blended hull of balls that touch them");
      case SomaForm::kFrusta:
        break;
    }
    if (soma.members.size() == 2) return remark("soma of two samples: made a capsule");
    const bool branches =
        std::any_of(soma.members.begin(), soma.members.end(), [&](int i) { return soma_children_[i] > 1; });
    remark(branches ? "soma that branches: made a frustum with round ends for each edge"
                    : "soma of a chain of samples: made a stack of frusta with round ends");
  }

  // Samples whose radius is below this part of the extent are drawn outlines: the radius is the width of the pen.
  static constexpr double kThin = 0.3;
  // Limits of an outline's semi-axes. Beyond these, numbers may leave the range of a scene after turning and
  // stretching.
  static constexpr double kLeast = 1e-6, kMost = 1e8;

  std::vector<SwcSample>& samples_;
  ImportReport& report_;
  std::vector<int> soma_children_;
  Somata found_;
};

}  // namespace

Somata find_somata(const std::vector<int>& order, std::vector<SwcSample>& samples, ImportReport& report) {
  return SomaFinder(order, samples, report).run();
}

}  // namespace isofield
