// How many different tables a scene's operators take on the device: each opening, silhouette and curve is one.
#pragma once

#include <set>

#include "operators/operator.h"

namespace isofield::blobtree {

class ProfileCount {
 public:
  void add(const operators::Operator& op) {
    if (const auto* opening = op.opening()) openings_.insert(*opening);
    if (const auto* gradient = op.as<operators::Gradient>()) silhouettes_.insert(gradient->silhouette);
    if (const auto* functional = op.as<operators::Functional>()) curves_.insert(functional->h);
  }
  std::size_t size() const { return openings_.size() + silhouettes_.size() + curves_.size(); }

 private:
  std::set<operators::Opening> openings_;
  std::set<operators::Silhouette> silhouettes_;
  std::set<operators::SampledCurve> curves_;
};

}  // namespace isofield::blobtree
