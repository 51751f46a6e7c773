#include "operators/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isofield::operators {
namespace {

constexpr double kQuarterPi = std::numbers::pi / 4;

using Numbers = std::array<double, 4>;

// Interpolated is the interpolated node with its slopes along f1, f2, theta.
struct Interpolated {
  Numbers v{};
  std::array<Numbers, 3> slope{};
};

Interpolated interpolate(std::array<double, 3> at, int size, const VolumeNodes& nodes) {
  const double last = size - 1;
  const std::array<double, 3> per_unit{last, last, last / kQuarterPi};
  std::array<int, 3> cell;
  std::array<double, 3> s;
  for (int a = 0; a < 3; ++a) {
    const double place = std::clamp(at[a] * per_unit[a], 0.0, last);
    cell[a] = std::min(static_cast<int>(place), size - 2);
    s[a] = place - cell[a];
  }
  std::array<Numbers, 8> corners;
  for (int c = 0; c < 8; ++c) {
    const VolumeNode n = nodes(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
    corners[c] = {n.g, n.g1, n.g2, n.gt};
  }
  if (cell[0] == cell[1]) {
    // A cell on the diagonal, where max and folds have an edge, is two prisms. The corner on the other side is replaced
    // by the one that makes the interpolation linear on this side.
    for (const int c : {0, 4}) {
      const int other = s[0] >= s[1] ? 2 : 1;
      for (int i = 0; i < 4; ++i) corners[c + other][i] = corners[c][i] + corners[c + 3][i] - corners[c + 3 - other][i];
    }
  }
  Interpolated r;
  for (int c = 0; c < 8; ++c) {
    std::array<double, 3> weight, sign;
    for (int a = 0; a < 3; ++a) {
      const bool upper = c >> a & 1;
      weight[a] = upper ? s[a] : 1 - s[a];
      sign[a] = upper ? 1 : -1;
    }
    for (int i = 0; i < 4; ++i) {
      r.v[i] += weight[0] * weight[1] * weight[2] * corners[c][i];
      for (int a = 0; a < 3; ++a) {
        r.slope[a][i] += sign[a] * per_unit[a] * weight[(a + 1) % 3] * weight[(a + 2) % 3] * corners[c][i];
      }
    }
  }
  return r;
}

Blend blend_of(const Interpolated& at) {
  const auto& [g, g1, g2, gt] = at.v;
  const auto& s = at.slope;
  return {g, g1, g2, gt, s[0][1], 0.5 * (s[0][2] + s[1][1]), s[1][2], s[2][1], s[2][2]};
}

Blend beyond_about_boundary(double f1, double f2, double theta, int size, const VolumeNodes& nodes) {
  const double t = std::tan(theta), h = t / 2, h_t = (1 + t * t) / 2;  // all derivatives here are by theta
  const double scale = (std::max(f1, f2) - h) / (1 - h), scale_t = h_t * (scale - 1) / (1 - h);
  const double p1 = h + (f1 - h) / scale, p2 = h + (f2 - h) / scale;
  const Blend b = blend_of(interpolate({p1, p2, theta}, size, nodes));
  const double p1_t = h_t * (1 - 1 / scale) - (p1 - h) * scale_t / scale;
  const double p2_t = h_t * (1 - 1 / scale) - (p2 - h) * scale_t / scale;
  Blend r = b;
  r.g = h + scale * (b.g - h);
  r.gt = h_t + scale_t * (b.g - h) + scale * (b.g1 * p1_t + b.g2 * p2_t + b.gt - h_t);
  r.g11 /= scale;
  r.g12 /= scale;
  r.g22 /= scale;
  r.g1t = b.g1t + b.g11 * p1_t + b.g12 * p2_t;
  r.g2t = b.g2t + b.g12 * p1_t + b.g22 * p2_t;
  return r;
}

// Continues the operator for f1 >= f2 as g = f1 G(1, f2 / f1).
Blend beyond_about_origin(const Blend& b, double f1, double p2) {
  Blend r;
  r.g = f1 * b.g;
  r.g1 = b.g - p2 * b.g2;
  r.g2 = b.g2;
  r.gt = f1 * b.gt;
  r.g22 = b.g22 / f1;
  r.g12 = -p2 * r.g22;
  r.g11 = p2 * p2 * r.g22;
  r.g1t = b.gt - p2 * b.g2t;
  r.g2t = b.g2t;
  return r;
}

Blend exchanged(const Blend& b) {
  return {b.g, b.g2, b.g1, b.gt, b.g22, b.g12, b.g11, b.g2t, b.g1t};
}

}  // namespace

VolumeNodes gradient_nodes(const Silhouette& silhouette, int size) {
  return [silhouette, last = static_cast<double>(size - 1)](int i, int j, int k) -> VolumeNode {
    const Blend b = gradient_blend(i / last, j / last, k / last * kQuarterPi, silhouette);
    return {b.g, b.g1, b.g2, b.gt};
  };
}

VolumeNodes sampled_nodes(const SampledVolume& samples) {
  return [&samples](int i, int j, int k) -> VolumeNode {
    const int n = samples.size;
    const auto value = [&](int i, int j, int k) {
      return double{samples.values[(static_cast<std::size_t>(k) * n + j) * n + i]};
    };
    const auto slope = [&](int di, int dj, int dk) {
      const int at = i * di + j * dj + k * dk, before = at > 0, after = at + 1 < n;
      return (value(i + after * di, j + after * dj, k + after * dk) -
              value(i - before * di, j - before * dj, k - before * dk)) *
             (n - 1) / (before + after);
    };
    return {value(i, j, k), slope(1, 0, 0), slope(0, 1, 0), slope(0, 0, 1) / kQuarterPi};
  };
}

Blend volume_blend(double f1, double f2, double theta, int size, const VolumeNodes& nodes, Continuation continuation) {
  if (f2 <= 0) return {f1, 1};
  if (f1 <= 0) return {f2, 0, 1};
  const double m = std::max(f1, f2);
  if (m <= 1) return blend_of(interpolate({f1, f2, theta}, size, nodes));
  if (continuation == Continuation::kAboutBoundary) return beyond_about_boundary(f1, f2, theta, size, nodes);
  const Blend b = blend_of(interpolate({f1 / m, f2 / m, theta}, size, nodes));
  return f1 >= f2 ? beyond_about_origin(b, f1, f2 / m) : exchanged(beyond_about_origin(exchanged(b), f2, f1 / m));
}

}  // namespace isofield::operators
