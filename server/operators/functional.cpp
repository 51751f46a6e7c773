#include "operators/functional.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"
#include "operators/tables.h"

namespace isofield::operators {
namespace {

constexpr int kMostControlPoints = 256;

SampledCurve read_control_points(const v1::FunctionalBlend& m, base::FieldReader& in) {
  if (m.x_size() < 2 || m.x_size() > kMostControlPoints) {
    in.refuse_count("x", m.x_size(), absl::StrCat("2 to ", kMostControlPoints, " of them"));
    return {};
  }
  if (m.h_size() != m.x_size()) {
    in.refuse_count("h", m.h_size(), absl::StrCat(m.x_size(), ", one for each x"));
    return {};
  }
  std::vector<double> x, h;
  for (int i = 0; i < m.x_size(); ++i) {
    x.push_back(in.coordinate(element_name("x", i), m.x(i)));
    h.push_back(in.coordinate(element_name("h", i), m.h(i)));
    if (i == 0 && x[i] < 0)
      in.refuse(element_name("x", i), absl::StrCat(x[i]), "a number >= 0: H is a function of |f1 - f2|");
    if (i > 0 && !(x[i] - x[i - 1] >= base::kMinLength)) {
      in.refuse(element_name("x", i), absl::StrCat(x[i]),
                absl::StrCat("more than ", x[i - 1], ", by at least ", base::kMinLength));
    }
  }
  if (!in.status().ok()) return {};
  return {std::move(x), std::move(h)};
}

// Returns the interval of |x1 - x2|.
Interval apart(const Interval& a, const Interval& b) {
  return {std::max({a.lo - b.hi, b.lo - a.hi, 0.0}), std::max(a.hi - b.lo, b.hi - a.lo)};
}

}  // namespace

Functional Functional::read(const v1::FunctionalBlend& message, base::FieldReader& in) {
  return {read_control_points(message, in)};
}

Opcode Functional::opcode(Law) const {
  return Opcode::kFunctional;
}

void Functional::write(const Use&, Tables& tables, Float4* out) const {
  const auto pieces = static_cast<std::uint32_t>(h.x().size() - 1);
  out[0] = {std::bit_cast<float>(tables.curve(h)), std::bit_cast<float>(pieces), f32(h.x().back()), f32(h.y().back())};
}

Interval Functional::bound(const Interval& a, const Interval& b) const {
  // H is monotone between control points.
  const Interval d = apart(a, b);
  double least = std::min(h.at(d.lo).v, h.at(d.hi).v), most = std::max(h.at(d.lo).v, h.at(d.hi).v);
  for (std::size_t i = 0; i < h.x().size(); ++i) {
    if (h.x()[i] <= d.lo || h.x()[i] >= d.hi) continue;
    least = std::min(least, h.y()[i]);
    most = std::max(most, h.y()[i]);
  }
  return base::padded(std::min(a.lo, b.lo) - most, std::min(a.hi, b.hi) - least);
}

Spread Functional::reached(std::size_t) const {
  return {.reach = std::max(h.most(), 0.0)};
}

Spread Functional::kept(std::size_t) const {
  return {.reach = std::max(-h.least(), 0.0)};
}

int Functional::lone_operand(const Interval& a, const Interval& b) const {
  // A last control point that is not 0 moves the field however far apart the operands are.
  if (h.y().back() != 0) return -1;
  const double room =
      base::kValueRoom * (std::max({std::abs(a.lo), std::abs(a.hi), std::abs(b.lo), std::abs(b.hi)}) + h.x().back());
  const double reach = h.x().back() + room;
  return b.lo - a.hi >= reach ? 0 : a.lo - b.hi >= reach ? 1 : -1;
}

}  // namespace isofield::operators
