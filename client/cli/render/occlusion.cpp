#include "render/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

#include "render/bands.h"

namespace isofield {
namespace {

constexpr int kSamples = 14;
// The turns of the spiral on which the samples lie. The number is coprime with that of the samples, so that these do
// not line up.
constexpr float kTurns = 5;
constexpr float kStrength = 1.7f;
// The pattern of rotations repeats in squares of this edge, in samples; noise is averaged over such squares.
constexpr int kPattern = 4;

class Occlusion {
 public:
  Occlusion(const Visibility& seen, const Camera& camera, float radius)
      : seen_(seen),
        radius_(radius),
        step_x_(2 * camera.tan_x / static_cast<float>(seen.width)),
        step_y_(2 * camera.tan_y / static_cast<float>(seen.height)) {
    for (int i = 0; i < kSamples * kPattern * kPattern; ++i) {
      const int rotation = i / kSamples;
      const float t = (static_cast<float>(i % kSamples) + 0.5f) / kSamples;
      const float angle = 2 * std::numbers::pi_v<float> * (t * kTurns + static_cast<float>(rotation * 7 % 16) / 16);
      spiral_[i] = {t * std::cos(angle), t * std::sin(angle)};
    }
  }

  float at(int x, int y) const {
    const std::size_t sample = index(x, y);
    const float inverse_depth = seen_.inverse_depth[sample];
    if (inverse_depth == 0) return 1;
    const glm::vec3 p = position(x, y, inverse_depth);
    const glm::vec3 n = seen_.normal(sample);
    const float reach = std::min(radius_ * inverse_depth / step_x_, 0.25f * static_cast<float>(seen_.width));
    if (reach < 1) return 1;
    const int rotation = (y % kPattern) * kPattern + x % kPattern;
    float occluded = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto& offset = spiral_[rotation * kSamples + i];
      const int sx = x + static_cast<int>(offset[0] * reach);
      const int sy = y + static_cast<int>(offset[1] * reach);
      if (sx < 0 || sy < 0 || sx >= seen_.width || sy >= seen_.height) continue;
      const float other = seen_.inverse_depth[index(sx, sy)];
      if (other == 0) continue;
      const glm::vec3 v = position(sx, sy, other) - p;
      const float distance2 = glm::dot(v, v);
      const float height = glm::dot(v, n) - 0.02f * radius_;
      if (height <= 0 || distance2 >= radius_ * radius_) continue;
      const float fade = 1 - distance2 / (radius_ * radius_);
      occluded += fade * height * radius_ / (distance2 + 0.01f * radius_ * radius_);
    }
    return std::max(0.0f, 1 - kStrength * occluded / kSamples);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(seen_.width) + static_cast<std::size_t>(x);
  }
  glm::vec3 position(int x, int y, float inverse_depth) const {
    const float depth = 1 / inverse_depth;
    return {(static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(seen_.width)) * step_x_ * depth,
            (0.5f * static_cast<float>(seen_.height) - static_cast<float>(y) - 0.5f) * step_y_ * depth, -depth};
  }

  const Visibility& seen_;
  const float radius_, step_x_, step_y_;
  std::array<glm::vec2, kSamples * kPattern * kPattern> spiral_;
};

// Averages over squares of kPattern, leaving out samples at another depth.
std::vector<float> smooth(const std::vector<float>& values, const Visibility& seen, float radius) {
  std::vector<float> out(values.size(), 1);
  for_each_band(seen.height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < seen.width; ++x) {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x);
        if (seen.inverse_depth[at] == 0) continue;
        const float depth = 1 / seen.inverse_depth[at];
        // This tests |1/a - 1/b| > radius approximately, without a division for each neighbour.
        const float tolerance = radius / (depth * depth);
        float sum = 0;
        float weight = 0;
        for (int dy = -kPattern / 2; dy < kPattern / 2; ++dy) {
          const int sy = y + dy;
          if (sy < 0 || sy >= seen.height) continue;
          for (int dx = -kPattern / 2; dx < kPattern / 2; ++dx) {
            const int sx = x + dx;
            if (sx < 0 || sx >= seen.width) continue;
            const std::size_t other = at + static_cast<std::size_t>(dy * seen.width + dx);
            if (std::abs(seen.inverse_depth[other] - seen.inverse_depth[at]) > tolerance) continue;
            sum += values[other];
            weight += 1;
          }
        }
        out[at] = sum / weight;
      }
    }
  });
  return out;
}

}  // namespace

std::vector<float> ambient_visibility(const Visibility& seen, const Camera& camera, float radius) {
  const Occlusion occlusion(seen, camera, radius);
  std::vector<float> values(seen.inverse_depth.size());
  for_each_band(seen.height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < seen.width; ++x) {
        values[static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x)] =
            occlusion.at(x, y);
      }
    }
  });
  return smooth(values, seen, 0.3f * radius);
}

}  // namespace isofield
