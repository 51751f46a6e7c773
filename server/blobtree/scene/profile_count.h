// How many different tables a scene's operators take on the device: each opening, silhouette and curve is one.
#pragma once

#include <set>

#include "operators/operator.h"

namespace isofield::blobtree {

class ProfileCount {
 public:
  void add(const operators::Operator& op) {
    if (op.is_steered()) openings_.insert(op.opening);
    if (op.kind == operators::Kind::kGradient) silhouettes_.insert(op.silhouette);
    if (op.kind == operators::Kind::kFunctional) curves_.insert(op.curve);
  }
  std::size_t size() const { return openings_.size() + silhouettes_.size() + curves_.size(); }

 private:
  std::set<operators::Opening> openings_;
  std::set<operators::Silhouette> silhouettes_;
  std::set<operators::SampledCurve> curves_;
};

}  // namespace isofield::blobtree
