#pragma once

#include <absl/numeric/int128.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <string>

#include "importers/vector3.h"

namespace isofield {

// Holds signed and unsigned numbers of 64 bits.
using SwcId = absl::int128;

inline constexpr long long kSomaType = 1;
inline constexpr int kNoParent = -1;

// A usable line of an SWC file.
struct SwcSample {
  SwcId id = 0;
  // 0 undefined, 1 soma, 2 axon, 3 basal dendrite, 4 apical dendrite; others are custom.
  long long type = 0;
  Vector3 center{};
  // 0 where the file has none that a scene could hold.
  double radius = 0;
  SwcId parent_id = -1;
  // The index of the parent's sample, or kNoParent.
  int parent = kNoParent;
  std::size_t line_number = 0;
  absl::string_view line;
};

inline bool is_soma(const SwcSample& sample) {
  return sample.type == kSomaType;
}

// "n17": the name of the piece that ends at the sample.
std::string piece_name(const SwcSample& sample);

}  // namespace isofield
