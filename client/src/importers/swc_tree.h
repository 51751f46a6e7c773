#pragma once

#include <absl/strings/string_view.h>

#include <array>
#include <cstddef>
#include <vector>

#include "isofield/import.h"

namespace isofield {

inline constexpr long long kSomaType = 1;
inline constexpr int kNoParent = -1;

// A usable line of an SWC file.
struct SwcSample {
  long long id = 0;
  long long type = 0;
  std::array<double, 3> center{};
  // <= 0 where the file has none that could be used.
  double radius = 0;
  long long parent_id = -1;
  // Index of the parent's sample, or kNoParent.
  int parent = kNoParent;
  std::size_t line_number = 0;
  absl::string_view line;
};

// Fills in `parent`. What has no parent in the file becomes a root; cycles are cut at their first sample.
void link_parents(std::vector<SwcSample>& samples, ImportReport& report);

// The samples' indices with each parent before its children: the file's order where that is one already, else depth
// first from each root. Needs linked parents.
std::vector<int> parents_first(const std::vector<SwcSample>& samples);

}  // namespace isofield
