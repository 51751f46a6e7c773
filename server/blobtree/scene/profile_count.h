// ProfileCount counts the different tables that a scene's operators take on the device. Each different opening,
// silhouette and curve is one table.
#pragma once

#include <set>

#include "operators/operator.h"

namespace isofield::blobtree {

class ProfileCount {
 public:
  void add(const operators::Operator& op) {
    if (const auto* opening = op.opening()) openings_.insert(*opening);
    op.visit([&](const auto& kind) {
      if constexpr (requires { kind.silhouette; }) silhouettes_.insert(kind.silhouette);
      if constexpr (requires { kind.h; }) curves_.insert(kind.h);
    });
  }
  std::size_t size() const { return openings_.size() + silhouettes_.size() + curves_.size(); }

 private:
  std::set<operators::Opening> openings_;
  std::set<operators::Silhouette> silhouettes_;
  std::set<operators::SampledCurve> curves_;
};

}  // namespace isofield::blobtree
