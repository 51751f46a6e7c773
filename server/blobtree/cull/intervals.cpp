#include "blobtree/cull/intervals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "operators/ranged_blends.h"
#include "operators/signed_blends.h"

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Reach;

double ricci(double a, double b, double t) {
  const double big = std::max(a, b), small = std::min(a, b);
  return big > 0 ? big * std::pow(1 + std::pow(small / big, t), 1 / t) : 0;
}

Interval padded(double lo, double hi) {
  const double room = kValueRoom * std::max({std::abs(lo), std::abs(hi), 1e-3});
  return {lo - room, hi + room};
}

// Weights that follow the gradients only grow, to so many times the other, so that fields only shrink towards 0.
Interval with_grown_weights(const Operation& o, const Interval& i) {
  if (!o.what->by_angle) return i;
  const auto [least, most] = std::minmax(o.what->term(0).weight, o.what->term(1).weight);
  const double shrunk = least / (most * operators::kMostRatio);
  return {i.lo > 0 ? i.lo * shrunk : i.lo, i.hi < 0 ? i.hi * shrunk : i.hi};
}

Interval pasko(const operators::Operator& op, const Interval& a, const Interval& b) {
  const auto r_union = [](double x, double y) { return x + y - std::hypot(x, y); };
  const auto farthest = [](const Interval& i) { return std::max(std::abs(i.lo), std::abs(i.hi)); };
  const auto nearest = [](const Interval& i) { return i.lo > 0 ? i.lo : i.hi < 0 ? -i.hi : 0; };
  const auto weight = [&](double x, double y) {
    return op.a0 / (1 + x * x / (op.a1 * op.a1) + y * y / (op.a2 * op.a2));
  };
  const double a0 = op.kind == operators::Kind::kPasko ? 1 : 0;
  const double near = a0 * weight(nearest(a), nearest(b)), far = a0 * weight(farthest(a), farthest(b));
  return padded(r_union(a.lo, b.lo) + std::min(near, far), r_union(a.hi, b.hi) + std::max(near, far));
}

// |x1 - x2|.
Interval apart(const Interval& a, const Interval& b) {
  return {std::max({a.lo - b.hi, b.lo - a.hi, 0.0}), std::max(a.hi - b.lo, b.hi - a.lo)};
}

Interval functional(const operators::SampledCurve& h, const Interval& a, const Interval& b) {
  // H is monotone between control points.
  const Interval d = apart(a, b);
  double least = std::min(h.at(d.lo).v, h.at(d.hi).v), most = std::max(h.at(d.lo).v, h.at(d.hi).v);
  for (std::size_t i = 0; i < h.x().size(); ++i) {
    if (h.x()[i] <= d.lo || h.x()[i] >= d.hi) continue;
    least = std::min(least, h.y()[i]);
    most = std::max(most, h.y()[i]);
  }
  return padded(std::min(a.lo, b.lo) - most, std::min(a.hi, b.hi) - least);
}

// Returns the operand of a functional blend, 0 or 1, that is the least by more than H reaches, or -1 where none is.
int least_operand(const operators::SampledCurve& h, const Interval& a, const Interval& b) {
  // A last control point that is not 0 moves the field however far apart the operands are.
  if (h.y().back() != 0) return -1;
  const double room = kValueRoom * (std::max({std::abs(a.lo), std::abs(a.hi), std::abs(b.lo), std::abs(b.hi)}) +
                                    h.x().back());
  const double reach = h.x().back() + room;
  return b.lo - a.hi >= reach ? 0 : a.lo - b.hi >= reach ? 1 : -1;
}

Interval bt2(const Operation& o, const Interval& a, const Interval& b) {
  const operators::Operator& op = *o.what;
  const operators::Term &t1 = op.term(0), &t2 = op.term(1);
  const auto at = [&](double x, double y, double reach) {
    return operators::bt2<double>(x, y, {t1.range * reach, t1.weight}, {t2.range * reach, t2.weight},
                                  op.tightness())
        .g;
  };
  const double reach = o.what->most_reach();
  // Wider ranges add material.
  const double lo = reach == 1 ? at(a.lo, b.lo, 1)
                               : std::min(a.lo / t1.weight, b.lo / t2.weight) -
                                     reach * std::max(t1.range / t1.weight, t2.range / t2.weight);
  const double hi = reach == 1 ? at(a.hi, b.hi, 1) : std::min(a.hi / t1.weight, b.hi / t2.weight);
  return with_grown_weights(o, padded(lo, hi));
}

// Close above the blend of the smooth silhouette at theta = 0, the most it is at any angle; high >= low.
double most_of_blend(double high, double low) {
  if (high <= 0) return high;
  // M(high, low) = high q(low / high). The profile is convex: its chords lie above it.
  constexpr int kChords = 64;
  static const auto profile = [] {
    std::array<double, kChords + 2> q{};
    for (int i = 0; i <= kChords; ++i) q[i] = operators::Silhouette{}.profile(static_cast<double>(i) / kChords).v;
    q[kChords + 1] = q[kChords];
    return q;
  }();
  const double at = std::max(low / high, 0.0) * kChords;
  const int i = static_cast<int>(at);
  return high * (profile[i] + (profile[i + 1] - profile[i]) * (at - i)) + kValueRoom * std::max(high, 1.0);
}

// Operands in their order; unions.
Interval union_interval(Operator op, const Operation& o, const Interval& a, const Interval& b) {
  switch (op) {
    case Operator::kSum:
      return {a.lo + b.lo, a.hi + b.hi};
    case Operator::kMax:
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
    case Operator::kMin:
      return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
    case Operator::kSubtract:
      return {std::max(std::min(a.lo, 1 - b.hi) - kValueRoom, 0.0), std::min(a.hi, 1 - b.lo)};
    case Operator::kRicci:
      return {ricci(a.lo, b.lo, o.what->exponent), ricci(a.hi, b.hi, o.what->exponent) + kValueRoom};
    case Operator::kGradient:
      // Increases with either field.
      return {std::max(a.lo, b.lo), most_of_blend(std::max(a.hi, b.hi), std::min(a.hi, b.hi))};
    case Operator::kGradientTable:
      // Between the maximum and the blend at theta = 0, whatever the angle.
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi) + o.silhouette_bound * std::min(a.hi, b.hi) + kValueRoom};
    case Operator::kClean:
    case Operator::kBarthe:
    case Operator::kBernhardt:
      // Arcs: at most a quarter of a circle around the origin.
      return {std::max(a.lo, b.lo), std::hypot(a.hi, b.hi) + kValueRoom};
    case Operator::kGradientVolume: {
      // Between nodes that are a step further; there between the maximum and what bounds them.
      const double high = std::max(a.hi, b.hi);
      const double step = std::max(high, 1.0) / (operators::volume_key(*o.what).size - 1);
      return {std::max(std::max(a.lo, b.lo) - step, 0.0), (high + step) * (1 + o.silhouette_bound) + kValueRoom};
    }
    case Operator::kPasko:
      return pasko(*o.what, a, b);
    case Operator::kFunctional:
      return functional(o.what->curve, a, b);
    case Operator::kBt2:
      return bt2(o, a, b);
    default:
      return b;
  }
}

}  // namespace

Interval complement(const Interval& i, bool is_signed) {
  const double whole = is_signed ? 0 : 1;
  return {whole - i.hi, whole - i.lo};
}

Interval binary_interval(Operator op, const Operation& o, const Mode& mode, Interval a, Interval b) {
  if (op == Operator::kSubtractFrom) return union_interval(Operator::kSubtract, o, b, a);
  if (mode.is_exchanged) std::swap(a, b);
  if (mode.form == Form::kUnion) return union_interval(op, o, a, b);
  const auto inside_out = [&](const Interval& i) {
    Interval c = complement(i, mode.is_signed);
    if (!mode.is_signed) c = {std::max(c.lo, 0.0), std::max(c.hi, 0.0)};
    return c;
  };
  const Interval first = a, second = b;
  a = inside_out(a);
  if (mode.form == Form::kIntersection) b = inside_out(b);
  Interval r = inside_out(union_interval(op, o, a, b));
  if (mode.form == Form::kIntersection && !mode.is_signed) {
    // The intersection of fields above 1 is the least of them.
    if (std::min(first.lo, second.lo) >= 1) r.lo = std::min(first.lo, second.lo);
    if (std::min(first.hi, second.hi) >= 1) r.hi = std::min(first.hi, second.hi);
  }
  // The complements round, too.
  return {mode.is_signed ? r.lo : std::max(r.lo - kValueRoom, 0.0), r.hi <= 0 ? r.hi : r.hi + kValueRoom};
}

Interval n_ary_interval(Operator op, const Operation& o, const Mode& mode, std::uint32_t mask,
                        std::vector<Interval> x) {
  const bool is_union = mode.form == Form::kUnion;
  std::vector<double> lows, highs, powers;
  std::vector<Reach<double>> reach;
  double low = 1, high = 1;
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < o.operands; ++i) {
    if (!(mask >> i & 1)) continue;
    Interval v = x[at++];
    if (mode.form == Form::kIntersection || (mode.form == Form::kDifference && i == 0)) v = complement(v, true);
    const operators::Term& t = o.what->term(i);
    if (op == Operator::kSuperelliptic) {
      low -= operators::superelliptic_bracket(
                 v.lo, v.lo > 0 ? t.range * o.what->most_reach() : t.range * (o.what->by_angle ? o.what->omega : 1),
                 o.what->exponent)
                 .value;
      high -= o.what->by_angle && v.hi > 0
                  ? 0
                  : operators::superelliptic_bracket(v.hi, t.range * o.what->most_reach(), o.what->exponent).value;
    }
    lows.push_back(v.lo);
    highs.push_back(v.hi);
    powers.push_back(t.power);
    reach.push_back({t.range, t.weight});
  }
  Interval r{low, high};
  if (op == Operator::kBtk) {
    r.hi = operators::btk(highs, reach, powers).g;
    if (o.what->by_angle) {
      double least = lows[0] / reach[0].weight, widest = 0;
      for (std::size_t i = 0; i < lows.size(); ++i) {
        least = std::min(least, lows[i] / reach[i].weight);
        widest = std::max(widest, reach[i].range * o.what->most_reach() / reach[i].weight);
        r.hi = i == 0 ? highs[i] / reach[i].weight : std::min(r.hi, highs[i] / reach[i].weight);
      }
      r.lo = least - widest;
    } else {
      r.lo = operators::btk(lows, reach, powers).g;
    }
    r = with_grown_weights(o, r);
  }
  r = padded(r.lo, r.hi);
  return is_union ? r : complement(r, true);
}

std::uint32_t active_operands(const Operation& o, const Mode& mode, std::uint32_t mask,
                              const std::vector<Interval>& x) {
  if (o.what->by_angle) return mask;
  const auto value = [&](std::uint32_t i, const Interval& v) {
    const bool turned = mode.form == Form::kIntersection || (mode.form == Form::kDifference && i == 0);
    return turned ? complement(v, true) : v;
  };
  double least = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < o.operands; ++i) {
    if (mask >> i & 1) least = std::min(least, value(i, x[at++]).hi / o.what->term(i).weight);
  }
  std::uint32_t active = 0;
  at = 0;
  for (std::uint32_t i = 0; i < o.operands; ++i) {
    if (!(mask >> i & 1)) continue;
    const operators::Term& t = o.what->term(i);
    const double low = value(i, x[at++]).lo;
    const double needed = t.range + t.weight * least;
    if (low < needed + kValueRoom * (std::abs(low) + std::abs(t.weight * least) + t.range)) active |= 1u << i;
  }
  // What is left of a difference is never its subtrahends alone.
  if (mode.form == Form::kDifference) active |= mask & 1;
  return active;
}

int lone_operand(const Operation& o, const Mode& mode, Interval a, Interval b) {
  if (o.what->by_angle) return -1;
  if (mode.is_exchanged) std::swap(a, b);
  if (mode.form != Form::kUnion) a = complement(a, true);
  if (mode.form == Form::kIntersection) b = complement(b, true);
  if (o.op == Operator::kFunctional) {
    const int least = least_operand(o.what->curve, a, b);
    return least == 1 && mode.form == Form::kDifference ? -1 : least;
  }
  const operators::Term &t1 = o.what->term(0), &t2 = o.what->term(1);
  // The bounds of the blending region, [H] section 3.
  const auto is_beyond = [](const Interval& x, const operators::Term& tx, const Interval& y,
                            const operators::Term& ty) {
    const double left = tx.weight * (y.lo - ty.range), right = ty.weight * x.hi;
    return left >= right + kValueRoom * (std::abs(right) + std::abs(tx.weight * y.lo) + tx.weight * ty.range);
  };
  if (is_beyond(a, t1, b, t2)) return 0;
  if (is_beyond(b, t2, a, t1) && mode.form != Form::kDifference) return 1;
  return -1;
}

}  // namespace isofield::blobtree
