#include "operators/sampled.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

#include "base/field_reader.h"
#include "isofield/v1/operator.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"
#include "operators/volume.h"

namespace isofield::operators {
namespace {

constexpr int kMostVolume = 128;

std::shared_ptr<const SampledVolume> read_volume(const v1::SampledOperator& m, base::FieldReader& in) {
  auto volume = std::make_shared<SampledVolume>();
  const auto n = static_cast<int>(m.size());
  if (m.size() < 2 || m.size() > kMostVolume) {
    in.refuse_number("size", m.size(), absl::StrCat("samples a side within [2, ", kMostVolume, "]"));
    return volume;
  }
  if (m.values_size() != n * n * n) {
    in.refuse_count("values", m.values_size(), absl::StrCat(n * n * n, ", size^3"));
    return volume;
  }
  volume->size = n;
  volume->values.assign(m.values().begin(), m.values().end());
  const double step = 1.0 / (n - 1);
  for (int i = 0; i < n * n * n && in.status().ok(); ++i) {
    const int x = i % n, y = i / n % n, z = i / (n * n);
    const float g = volume->values[i];
    const auto refuse = [&](absl::string_view expected) {
      in.refuse(absl::StrCat(element_name("values", i), " (f1 = ", x * step, ", f2 = ", y * step,
                             ", theta = ", 45 * z * step, " degrees)"),
                absl::StrCat(g), expected);
    };
    if (!std::isfinite(g) || std::abs(g) > 16) {
      refuse("a finite number of magnitude at most 16");
    } else if ((x == 0 || y == 0) && std::abs(g - std::max(x, y) * step) > 1e-4) {
      refuse("the other field where one is 0, within 1e-4");
    } else if (x > 0 && !(g >= volume->values[i - 1] - 1e-6f)) {
      refuse(absl::StrCat("no less than at the sample before along f1, ", volume->values[i - 1]));
    } else if (y > 0 && !(g >= volume->values[i - n] - 1e-6f)) {
      refuse(absl::StrCat("no less than at the sample before along f2, ", volume->values[i - n]));
    }
  }
  return volume;
}

}  // namespace

Sampled Sampled::read(const v1::SampledOperator& message, base::FieldReader& in) {
  Sampled op;
  op.opening = read_opening(message.opening(), in);
  op.samples = read_volume(message, in);
  return op;
}

Opcode Sampled::opcode(Law) const {
  return Opcode::kGradientVolume;
}

void Sampled::write(const Use& use, Tables& tables, Float4* out) const {
  out[0] = steered_record(opening, volume_word(use.volume_slot, samples->size), use, tables);
  // The sign tells this volume, which is homogeneous about the origin beyond its nodes, from a volume of the gradient
  // blend, which is homogeneous about (t/2, t/2).
  out[0][3] = -out[0][3];
}

Blend Sampled::blend(double f1, double f2, double theta) const {
  return volume_blend(f1, f2, theta, samples->size, sampled_nodes(*samples), Continuation::kAboutOrigin);
}

double Sampled::growth(SilhouetteBounds&) const {
  double bound = 0;
  const int n = samples->size;
  for (int i = 0; i < n * n * n; ++i) {
    const int most = std::max(i % n, i / n % n);
    if (most > 0) bound = std::max(bound, double{samples->values[i]} * (n - 1) / most - 1);
  }
  return bound;
}

Interval Sampled::bound(const Interval& a, const Interval& b, double growth) const {
  return volume_bound(a, b, samples->size, growth);
}

}  // namespace isofield::operators
