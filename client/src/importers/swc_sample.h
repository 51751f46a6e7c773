// A sample of a neuron: one line of an SWC file.
#pragma once

#include <absl/numeric/int128.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

namespace isofield {

// An id, wide enough for signed and for unsigned numbers of 64 bits, since files have either.
using SwcId = absl::int128;

inline constexpr long long kSomaType = 1;
inline constexpr int kNoParent = -1;

// A usable line of an SWC file.
struct SwcSample {
  SwcId id = 0;
  // The kind of the sample: 0 is undefined, 1 a soma, 2 an axon, 3 a basal and 4 an apical dendrite; other types are
  // custom.
  long long type = 0;
  glm::dvec3 center{};
  // The radius, or 0 where the file states none that a scene can hold.
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

// Returns the name of the piece that ends at the sample, such as "n17".
std::string piece_name(const SwcSample& sample);

}  // namespace isofield
