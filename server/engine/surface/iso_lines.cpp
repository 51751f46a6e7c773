#include "engine/surface/iso_lines.h"

namespace isofield::engine {
namespace {

constexpr std::uint32_t kNoEdge = ~0u;

// Traces the lines. An edge between two samples has the number 2 s + axis, with s the number of its lower sample.
class Tracer {
 public:
  Tracer(std::span<const float> values, std::array<std::uint32_t, 2> counts, float level)
      : values_(values), counts_(counts), level_(level), next_(2 * values.size(), kNoEdge), has_before_(next_.size()) {}

  Polylines run() {
    for (std::uint32_t j = 0; j + 1 < counts_[1]; ++j) {
      for (std::uint32_t i = 0; i + 1 < counts_[0]; ++i) link(i, j);
    }
    lines_.starts.push_back(0);
    for (std::uint32_t edge = 0; edge < next_.size(); ++edge) {
      if (next_[edge] != kNoEdge && !has_before_[edge]) follow(edge);
    }
    for (std::uint32_t edge = 0; edge < next_.size(); ++edge) {
      if (next_[edge] != kNoEdge) follow(edge);
    }
    return std::move(lines_);
  }

 private:
  // Notes the pieces of the curve within a square.
  void link(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t low = j * counts_[0] + i, up = low + counts_[0];
    // Corners and edges go counter-clockwise; edge k leads from corner k to the next.
    const std::array<std::uint32_t, 4> corners{low, low + 1, up + 1, up};
    const std::array<std::uint32_t, 4> edges{2 * low, 2 * (low + 1) + 1, 2 * up, 2 * low + 1};
    const auto above = [&](std::uint32_t k) { return values_[corners[k % 4]] > level_; };
    std::array<std::uint32_t, 2> entries{}, exits{};  // exits[n] is the first exit after entries[n]
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (above(k) || !above(k + 1)) continue;
      entries[count] = edges[k];
      std::uint32_t exit = k + 1;
      while (above(exit + 1)) ++exit;
      exits[count++] = edges[exit % 4];
    }
    if (count == 2) {
      const double mean =
          (double{values_[corners[0]]} + values_[corners[1]] + values_[corners[2]] + values_[corners[3]]) / 4;
      if (mean > level_) std::swap(entries[0], entries[1]);
    }
    for (std::uint32_t n = 0; n < count; ++n) {
      next_[exits[n]] = entries[n];
      has_before_[entries[n]] = true;
    }
  }

  void follow(std::uint32_t first) {
    std::uint32_t edge = first;
    while (edge != kNoEdge) {
      add(edge);
      const std::uint32_t next = next_[edge];
      next_[edge] = kNoEdge;
      edge = next;
    }
    lines_.starts.push_back(static_cast<std::uint32_t>(lines_.points.size() / 2));
  }

  void add(std::uint32_t edge) {
    const std::uint32_t sample = edge / 2;
    const float a = values_[sample], b = values_[sample + (edge % 2 ? counts_[0] : 1)];
    const float part = static_cast<float>((double{level_} - a) / (double{b} - a));
    const std::uint32_t column = sample % counts_[0], row = sample / counts_[0];
    const auto i = static_cast<float>(column), j = static_cast<float>(row);
    lines_.points.push_back(edge % 2 ? i : i + part);
    lines_.points.push_back(edge % 2 ? j + part : j);
  }

  const std::span<const float> values_;
  const std::array<std::uint32_t, 2> counts_;
  const float level_;
  std::vector<std::uint32_t> next_;  // the next edge that the curve crosses after each; removed as it is followed
  std::vector<bool> has_before_;
  Polylines lines_;
};

}  // namespace

Polylines iso_lines(std::span<const float> values, std::array<std::uint32_t, 2> counts, float level) {
  return Tracer(values, counts, level).run();
}

}  // namespace isofield::engine
