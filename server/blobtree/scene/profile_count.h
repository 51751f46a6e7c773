// ProfileCount counts the different tables that a scene's operators take on the device. Each different opening,
// silhouette and curve is one table.
#pragma once

#include <set>

#include "operators/operator.h"

namespace isofield::blobtree {

class ProfileCount {
 public:
  // Counts the tables of an operator. Returns the field of the last one that is new, or null if all are known.
  const char* add(const operators::Operator& op) {
    const char* field = nullptr;
    if (const auto* opening = op.opening(); opening && openings_.insert(*opening).second) field = "opening";
    op.visit([&](const auto& kind) {
      if constexpr (requires { kind.silhouette; }) {
        if (silhouettes_.insert(kind.silhouette).second) field = "silhouette";
      }
      if constexpr (requires { kind.h; }) {
        if (curves_.insert(kind.h).second) field = "h";
      }
    });
    return field;
  }
  std::size_t size() const { return openings_.size() + silhouettes_.size() + curves_.size(); }

 private:
  std::set<operators::Opening> openings_;
  std::set<operators::Silhouette> silhouettes_;
  std::set<operators::SampledCurve> curves_;
};

}  // namespace isofield::blobtree
