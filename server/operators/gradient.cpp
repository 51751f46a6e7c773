#include "operators/gradient.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/profile_table.h"
#include "operators/reading.h"
#include "operators/tables.h"
#include "operators/volume.h"

namespace isofield::operators {
namespace {

Silhouette read_sampled_silhouette(const base::FieldReader::Numbers& numbers, base::FieldReader& in) {
  const std::vector<double> s =
      read_samples("silhouette.samples", numbers, 1e-3, 2, 1, "a distance from the origin, within [0.001, 2]", in);
  Silhouette silhouette{Silhouette::Kind::kSampled, 0, SampledCurve::even(0, std::numbers::pi / 2, s)};
  if (!in.status().ok()) return silhouette;
  const int last = static_cast<int>(s.size()) - 1;
  for (const int end : {0, last}) {
    if (std::abs(s[end] - 1) > 1e-9) {
      in.refuse(element_name("silhouette.samples", end), absl::StrCat(s[end]),
                "1 at both ends, where the blend meets the fields");
    }
  }
  for (int i = 0; i <= last; ++i) {
    // It is enough to check the samples, because the monotone cubic between them stays within their range.
    const double phi = std::numbers::pi / 2 * i / last;
    const double square = 1 / std::max(std::cos(phi), std::sin(phi));
    in.number(element_name("silhouette.samples", i), s[i], 0.5001 * square, square * (1 + 1e-9),
              absl::StrCat("a distance within ]", 0.5 * square, ", ", square,
                           "] at this angle: not beyond the unit square, nor within half of it"));
    const bool is_first = 2 * i <= last;
    const double u = std::min(std::tan(is_first ? phi : std::numbers::pi / 2 - phi), 1.0);
    using Half = Silhouette::Half;
    const Curve q = silhouette.profile(u, is_first ? Half::kFirst : Half::kSecond);
    // The blend is the only root while k' (1 - M_a - M_b) < 1, and k' is at most 2.
    if (!(q.v + (1 - u) * q.d1 > 0.55)) {
      in.refuse(element_name("silhouette.samples", i), absl::StrCat(s[i]),
                "a curve that rises less steeply there: more than one level would pass through a point");
    }
  }
  return silhouette;
}

Silhouette read_silhouette(const v1::Silhouette& m, base::FieldReader& in) {
  v1::Silhouette::Kind kind = m.kind();
  if (kind == v1::Silhouette::KIND_UNSPECIFIED) {
    kind = m.samples().empty() ? v1::Silhouette::SMOOTH : v1::Silhouette::SAMPLED;
  }
  if (m.k() != 0 && kind != v1::Silhouette::BULGE)
    in.refuse("silhouette.k", absl::StrCat(m.k()), "no k, or kind BULGE");
  if (!m.samples().empty() && kind != v1::Silhouette::SAMPLED) {
    in.refuse("silhouette.samples", "[stated]", "no samples, or kind SAMPLED");
  }
  switch (kind) {
    case v1::Silhouette::SMOOTH:
      return {};
    case v1::Silhouette::BULGE:
      return {Silhouette::Kind::kBulge, in.number("silhouette.k", m.k(), 0, 1, "a strength within [0, 1]")};
    case v1::Silhouette::SAMPLED:
      return read_sampled_silhouette(m.samples(), in);
    default:
      in.refuse("silhouette.kind", absl::StrCat(static_cast<int>(m.kind())), "SMOOTH, BULGE or SAMPLED");
      return {};
  }
}

// Returns a number close above the blend of the smooth silhouette at theta = 0, which is the largest at any angle. It
// needs high >= low.
double most_of_blend(double high, double low) {
  if (high <= 0) return high;
  // M(high, low) = high q(low / high). The profile is convex, so that its chords lie above it.
  constexpr int kChords = 64;
  static const auto profile = [] {
    std::array<double, kChords + 2> q{};
    for (int i = 0; i <= kChords; ++i) q[i] = Silhouette{}.profile(static_cast<double>(i) / kChords).v;
    q[kChords + 1] = q[kChords];
    return q;
  }();
  const double at = std::max(low / high, 0.0) * kChords;
  const int i = static_cast<int>(at);
  return high * (profile[i] + (profile[i + 1] - profile[i]) * (at - i)) + base::kValueRoom * std::max(high, 1.0);
}

bool is_smooth(const Silhouette& silhouette) {
  return silhouette.kind == Silhouette::Kind::kSmooth;
}

}  // namespace

Gradient Gradient::read(const v1::GradientBlend& message, base::FieldReader& in) {
  Gradient op;
  op.opening = read_opening(message.opening(), in);
  op.silhouette = read_silhouette(message.silhouette(), in);
  const std::uint32_t volume = message.volume();
  if (volume != 0 && volume != 16 && volume != 32 && volume != 64 && volume != 128) {
    in.refuse("volume", absl::StrCat(volume), "0, 16, 32, 64 or 128 samples a side");
  }
  if (volume != 0 && !op.silhouette.is_symmetric()) {
    in.refuse("volume", absl::StrCat(volume), "0 with a sampled silhouette, which is a table");
  }
  op.volume = static_cast<int>(volume);
  return op;
}

bool Gradient::may_crease() const {
  // Tables and volumes may have folds of their own.
  return volume != 0 || !is_smooth(silhouette) || is_sharp(opening);
}

Opcode Gradient::opcode(Law) const {
  if (volume != 0) return Opcode::kGradientVolume;
  return is_smooth(silhouette) ? Opcode::kGradient : Opcode::kGradientTable;
}

void Gradient::write(const Use& use, Tables& tables, Float4* out) const {
  const std::uint32_t blend = volume != 0             ? volume_word(use.volume_slot, volume)
                              : is_smooth(silhouette) ? 0
                                                      : tables.silhouette(silhouette);
  out[0] = steered_record(opening, blend, use, tables);
}

Blend Gradient::blend(double f1, double f2, double theta) const {
  if (volume == 0) return gradient_blend(f1, f2, theta, silhouette);
  return volume_blend(f1, f2, theta, volume, gradient_nodes(silhouette, volume), Continuation::kAboutBoundary);
}

double Gradient::growth(SilhouetteBounds& silhouettes) const {
  const auto [known, is_new] = silhouettes.try_emplace(silhouette);
  if (is_new) known->second = silhouette_bound(silhouette);
  return known->second;
}

Interval Gradient::bound(const Interval& a, const Interval& b, double growth) const {
  if (volume != 0) return volume_bound(a, b, volume, growth);
  const double least = std::max(a.lo, b.lo), high = std::max(a.hi, b.hi), low = std::min(a.hi, b.hi);
  // The smooth blend increases with either field.
  if (is_smooth(silhouette)) return {least, most_of_blend(high, low)};
  // The blend lies between the maximum and the blend at theta = 0, whatever the angle.
  return {least, high + growth * low + base::kValueRoom};
}

}  // namespace isofield::operators
