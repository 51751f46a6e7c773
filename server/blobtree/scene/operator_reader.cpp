#include "blobtree/scene/operator_reader.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace isofield::blobtree {
namespace {

using operators::Kind;
using operators::Operator;
using Numbers = FieldReader::Numbers;

constexpr double kPi = std::numbers::pi;
constexpr double kRadians = kPi / 180;
constexpr int kLeastSamples = 3, kMostSamples = 4096;
constexpr int kMostControlPoints = 256;
constexpr int kMostVolume = 128;
// The limits of 1 - p / (r1 r2) of a conic. It degenerates at p = r1 r2; where p = -1e14 r^2 it is nowhere further than
// 7e-8 r from the union.
constexpr double kLeastTightness = 1e-9, kMostTightness = 1e14;

std::string at(absl::string_view field, int i) {
  return absl::StrCat(field, "[", i, "]");
}

// The samples of a curve within [least, most], times `unit`.
std::vector<double> read_samples(absl::string_view field, const Numbers& numbers, double least, double most,
                                 double unit, absl::string_view expected, FieldReader& in) {
  if (numbers.size() < kLeastSamples || numbers.size() > kMostSamples) {
    in.refuse_count(field, numbers.size(), absl::StrCat(kLeastSamples, " to ", kMostSamples, " samples"));
    return {0, 0};
  }
  std::vector<double> samples;
  for (int i = 0; i < numbers.size(); ++i) {
    samples.push_back(in.number(at(field, i), numbers[i], least, most, expected) * unit);
  }
  return samples;
}

operators::Opening read_opening(const v1::Opening& m, FieldReader& in) {
  operators::Opening o = operators::camel();
  if (m.preset() == v1::Opening::ORGANIC) o = operators::organic();
  if (m.preset() == v1::Opening::CONTACT) o = operators::contact();
  if (m.preset() < 0 || m.preset() > v1::Opening::CONTACT) {
    in.refuse("opening.preset", absl::StrCat(static_cast<int>(m.preset())), "CAMEL, ORGANIC or CONTACT");
  }
  const bool stated[] = {m.has_alpha0(), m.has_alpha1(), m.has_alpha2(), m.has_theta0(),
                         m.has_theta1(), m.has_theta2(), m.has_w0(),     m.has_w1()};
  const double values[] = {m.alpha0(), m.alpha1(), m.alpha2(), m.theta0(), m.theta1(), m.theta2(), m.w0(), m.w1()};
  constexpr const char* kNames[] = {"opening.alpha0", "opening.alpha1", "opening.alpha2", "opening.theta0",
                                    "opening.theta1", "opening.theta2", "opening.w0",     "opening.w1"};
  double* const parameters[] = {&o.alpha0, &o.alpha1, &o.alpha2, &o.theta0, &o.theta1, &o.theta2, &o.w0, &o.w1};
  bool any = m.preset() != v1::Opening::PRESET_UNSPECIFIED, all = true;
  for (bool s : stated) any |= s, all &= s;
  if (!m.samples().empty()) {
    if (any) in.refuse("opening.samples", "[stated]", "either samples or a preset and parameters, not both");
    // The parameters stay those of no opening, so that equal samples make equal openings.
    o = {};
    o.samples = operators::SampledCurve::even(
        0, kPi, read_samples("opening.samples", m.samples(), 0, 45, kRadians, "degrees within [0, 45]", in));
    return o;
  }
  if (m.preset() == v1::Opening::PRESET_UNSPECIFIED && any && !all) {
    for (int i = 0; i < 8; ++i) {
      if (!stated[i]) in.miss(kNames[i], "a value, or a preset that supplies it");
    }
  }
  for (int i = 0; i < 8; ++i) {
    if (!stated[i]) continue;
    if (i < 3) {
      *parameters[i] = in.number(kNames[i], values[i], 0, 180, "degrees within [0, 180]") * kRadians;
    } else if (i < 6) {
      *parameters[i] = in.number(kNames[i], values[i], 0, 45, "degrees within [0, 45]") * kRadians;
    } else {
      *parameters[i] = in.number(kNames[i], values[i], 0.05, 20, "a slope within [0.05, 20]");
    }
  }
  const auto degrees = [](double radians) { return absl::StrCat(radians / kRadians); };
  // A ramp of exactly the least length may have been rounded to less.
  constexpr double kLeast = operators::kLeastRamp * (1 - 1e-9);
  const std::string by = absl::StrCat("by ", operators::kLeastRamp / kRadians, " (a thousandth of a radian) or more");
  if (!(o.alpha1 - o.alpha0 >= kLeast)) {
    in.refuse("opening.alpha1", degrees(o.alpha1), absl::StrCat("more than alpha0 = ", degrees(o.alpha0), ", ", by));
  }
  if (!(o.alpha2 - o.alpha1 >= kLeast)) {
    in.refuse("opening.alpha2", degrees(o.alpha2), absl::StrCat("more than alpha1 = ", degrees(o.alpha1), ", ", by));
  }
  return o;
}

operators::Silhouette read_sampled_silhouette(const Numbers& numbers, FieldReader& in) {
  const std::vector<double> s =
      read_samples("silhouette.samples", numbers, 1e-3, 2, 1, "a distance from the origin, within [0.001, 2]", in);
  operators::Silhouette silhouette{operators::Silhouette::Kind::kSampled, 0,
                                   operators::SampledCurve::even(0, kPi / 2, s)};
  if (!in.status().ok()) return silhouette;
  const int last = static_cast<int>(s.size()) - 1;
  for (const int end : {0, last}) {
    if (std::abs(s[end] - 1) > 1e-9) {
      in.refuse(at("silhouette.samples", end), absl::StrCat(s[end]),
                "1 at both ends, where the blend meets the fields");
    }
  }
  for (int i = 0; i <= last; ++i) {
    // Everything is told at samples: the monotone cubic between them stays within their range.
    const double phi = kPi / 2 * i / last;
    const double square = 1 / std::max(std::cos(phi), std::sin(phi));
    in.number(at("silhouette.samples", i), s[i], 0.5001 * square, square * (1 + 1e-9),
              absl::StrCat("a distance within ]", 0.5 * square, ", ", square,
                           "] at this angle: not beyond the unit square, nor within half of it"));
    const bool is_first = 2 * i <= last;
    const double u = std::min(std::tan(is_first ? phi : kPi / 2 - phi), 1.0);
    using Half = operators::Silhouette::Half;
    const operators::Curve q = silhouette.profile(u, is_first ? Half::kFirst : Half::kSecond);
    // The blend is the only root while k' (1 - M_a - M_b) < 1, and k' is at most 2.
    if (!(q.v + (1 - u) * q.d1 > 0.55)) {
      in.refuse(at("silhouette.samples", i), absl::StrCat(s[i]),
                "a curve that rises less steeply there: more than one level would pass through a point");
    }
  }
  return silhouette;
}

operators::Silhouette read_silhouette(const v1::Silhouette& m, FieldReader& in) {
  using operators::Silhouette;
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

std::shared_ptr<const operators::SampledVolume> read_volume(const v1::SampledOperator& m, FieldReader& in) {
  auto volume = std::make_shared<operators::SampledVolume>();
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
      in.refuse(absl::StrCat(at("values", i), " (f1 = ", x * step, ", f2 = ", y * step, ", theta = ", 45 * z * step,
                             " degrees)"),
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

operators::SampledCurve read_control_points(const v1::FunctionalBlend& m, FieldReader& in) {
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
    x.push_back(in.coordinate(at("x", i), m.x(i)));
    h.push_back(in.coordinate(at("h", i), m.h(i)));
    if (i == 0 && x[i] < 0) in.refuse(at("x", i), absl::StrCat(x[i]), "a number >= 0: H is a function of |f1 - f2|");
    if (i > 0 && !(x[i] - x[i - 1] >= kMinLength)) {
      in.refuse(at("x", i), absl::StrCat(x[i]), absl::StrCat("more than ", x[i - 1], ", by at least ", kMinLength));
    }
  }
  if (!in.status().ok()) return {};
  return {std::move(x), std::move(h)};
}

operators::Form read_form(v1::Form form, FieldReader& in) {
  switch (form) {
    case v1::FORM_UNSPECIFIED:
    case v1::UNION:
      return operators::Form::kUnion;
    case v1::INTERSECTION:
      return operators::Form::kIntersection;
    case v1::DIFFERENCE:
      return operators::Form::kDifference;
    default:
      in.refuse("form", absl::StrCat(static_cast<int>(form)), "UNION, INTERSECTION or DIFFERENCE");
      return operators::Form::kUnion;
  }
}

double read_tangent_angle(absl::string_view field, double degrees, FieldReader& in) {
  return in.number(field, degrees, 0, 45, "degrees within [0, 45]") * kRadians;
}

void read_angle(bool by_angle, double omega, Operator& op, FieldReader& in) {
  op.by_angle = by_angle;
  if (omega != 0) op.omega = in.number("omega", omega, 0.001, 1, "a number within [0.001, 1], or 0 for 0.01");
}

// One of a list that has one number for each operand, one for all, or, where it may be empty, the default.
double listed(const Numbers& numbers, std::size_t i, double otherwise) {
  if (numbers.empty()) return otherwise;
  return numbers.size() == 1 ? numbers[0] : i < static_cast<std::size_t>(numbers.size()) ? numbers[i] : otherwise;
}

void read_terms(const Numbers& ranges, const Numbers& powers, const Numbers& weights, Operator& op, FieldReader& in) {
  const int count = std::max({ranges.size(), powers.size(), weights.size()});
  if (count > static_cast<int>(kMaxOperands)) {
    in.refuse("ranges", absl::StrCat("[", count, " numbers]"), absl::StrCat("at most ", kMaxOperands));
    return;
  }
  if (ranges.empty()) in.miss("ranges", "one range, or one for each child");
  const struct {
    const char* name;
    const Numbers& numbers;
  } lists[] = {{"ranges", ranges}, {"powers", powers}, {"weights", weights}};
  for (const auto& [name, numbers] : lists) {
    if (numbers.size() > 1 && numbers.size() != count) {
      in.refuse(name, absl::StrCat("[", numbers.size(), " numbers]"), absl::StrCat("1 or ", count, " of them"));
    }
  }
  for (int i = 0; i < count; ++i) {
    operators::Term t{listed(ranges, i, 1), listed(powers, i, 2), listed(weights, i, 1)};
    in.positive("ranges", t.range, absl::StrCat("[", i, "]"));
    in.number(at("powers", i), t.power, 1.0001, 64, "an exponent within ]1, 64]");
    in.number(at("weights", i), t.weight, 1e-3, 1e3, "a weight within [0.001, 1000]");
    op.terms.push_back(t);
  }
}

void read_bt2(const v1::Bt2& m, Operator& op, FieldReader& in) {
  const auto weight = [&](const char* name, bool has, double value) {
    return has ? in.number(name, value, 1e-3, 1e3, "a weight within [0.001, 1000]") : 1.0;
  };
  const double r1 = in.positive("r1", m.r1()), r2 = in.positive("r2", m.r2());
  op.terms = {{r1, 2, weight("m1", m.has_m1(), m.m1())}, {r2, 2, weight("m2", m.has_m2(), m.m2())}};
  op.conic = in.number("p", m.p(), -kMostTightness * r1 * r2, (1 - kLeastTightness) * r1 * r2,
                       absl::StrCat("a number below r1 r2 = ", r1 * r2, " by at least ", kLeastTightness,
                                    " of it, and at least ", -kMostTightness,
                                    " times it: float32 does not tell blends beyond from the union"));
  read_angle(m.eliminate_bulge(), m.omega(), op, in);
}

// Of a Node or an Operator message, which name their fields alike.
template <class Message>
std::optional<Operator> read_kind(const Message& m, FieldReader& in) {
  Operator op;
  const auto classic = [&](Kind kind, const auto& blend) {
    op.kind = kind;
    op.form = read_form(blend.form(), in);
  };
  if (m.has_sum()) {
    op.kind = Kind::kSum;
  } else if (m.has_max()) {
    op.kind = Kind::kMax;
  } else if (m.has_min()) {
    op.kind = Kind::kMin;
  } else if (m.has_difference()) {
    op.kind = Kind::kDifference;
  } else if (m.has_ricci()) {
    op.kind = Kind::kRicci;
    op.exponent = in.required_number("exponent", m.ricci().exponent(), 1, 64, "an exponent within [1, 64]");
  } else if (m.has_gradient()) {
    classic(Kind::kGradient, m.gradient());
    op.opening = read_opening(m.gradient().opening(), in);
    op.silhouette = read_silhouette(m.gradient().silhouette(), in);
    const std::uint32_t volume = m.gradient().volume();
    if (volume != 0 && volume != 16 && volume != 32 && volume != 64 && volume != 128) {
      in.refuse("volume", absl::StrCat(volume), "0, 16, 32, 64 or 128 samples a side");
    }
    if (volume != 0 && !op.silhouette.is_symmetric()) {
      in.refuse("volume", absl::StrCat(volume), "0 with a sampled silhouette, which is a table");
    }
    op.volume = static_cast<int>(volume);
  } else if (m.has_clean()) {
    classic(Kind::kClean, m.clean());
  } else if (m.has_barthe()) {
    classic(Kind::kBarthe, m.barthe());
    op.theta1 = read_tangent_angle("theta1", m.barthe().theta1(), in);
    op.theta2 = read_tangent_angle("theta2", m.barthe().theta2(), in);
  } else if (m.has_bernhardt()) {
    classic(Kind::kBernhardt, m.bernhardt());
    op.theta1 = read_tangent_angle("theta1", m.bernhardt().theta1(), in);
    op.theta2 = read_tangent_angle("theta2", m.bernhardt().theta2(), in);
    op.weight = in.number("weight", m.bernhardt().weight(), 0, 1, "a weight within [0, 1]");
  } else if (m.has_r_union()) {
    classic(Kind::kRUnion, m.r_union());
  } else if (m.has_pasko()) {
    classic(Kind::kPasko, m.pasko());
    op.a0 = in.coordinate("a0", m.pasko().a0());
    op.a1 = in.positive("a1", m.pasko().a1());
    op.a2 = in.positive("a2", m.pasko().a2());
  } else if (m.has_superelliptic()) {
    classic(Kind::kSuperelliptic, m.superelliptic());
    op.exponent = in.required_number("exponent", m.superelliptic().exponent(), 1, 64, "an exponent within [1, 64]");
    read_terms(m.superelliptic().ranges(), {}, {}, op, in);
    read_angle(m.superelliptic().by_angle(), m.superelliptic().omega(), op, in);
  } else if (m.has_functional()) {
    classic(Kind::kFunctional, m.functional());
    op.curve = read_control_points(m.functional(), in);
  } else if (m.has_bt2()) {
    classic(Kind::kBt2, m.bt2());
    read_bt2(m.bt2(), op, in);
  } else if (m.has_btk()) {
    classic(Kind::kBtk, m.btk());
    read_terms(m.btk().ranges(), m.btk().powers(), m.btk().weights(), op, in);
    read_angle(m.btk().eliminate_bulge(), m.btk().omega(), op, in);
  } else {
    return std::nullopt;
  }
  return op;
}

}  // namespace

absl::StatusOr<std::shared_ptr<const Operator>> read_operator(const v1::Operator& message) {
  const std::string path = "operator";
  FieldReader in(path);
  std::optional<Operator> op = read_kind(message, in);
  if (!op && message.has_sampled()) {
    op.emplace();
    op->kind = Kind::kSampled;
    op->form = read_form(message.sampled().form(), in);
    op->opening = read_opening(message.sampled().opening(), in);
    op->samples = read_volume(message.sampled(), in);
  }
  if (!op) {
    in.miss("kind",
            "one of sum, max, min, difference, ricci, gradient, clean, barthe, bernhardt, r_union, pasko, "
            "superelliptic, functional, bt2, btk, sampled");
  } else {
    // Operands come with the nodes that use the operator.
    const auto* kind =
        message.GetReflection()->GetOneofFieldDescriptor(message, v1::Operator::descriptor()->FindOneofByName("kind"));
    const auto& body = message.GetReflection()->GetMessage(message, kind);
    const auto* children = body.GetDescriptor()->FindFieldByName("children");
    if (children && body.GetReflection()->FieldSize(body, children) > 0) {
      in.refuse(absl::StrCat(std::string(kind->name()), ".children"), "[stated]", "no children");
    }
  }
  if (!in.status().ok()) return in.status();
  return std::make_shared<const Operator>(*std::move(op));
}

absl::StatusOr<operators::Opening> read_opening(const v1::Opening& message) {
  const std::string path = "operator";
  FieldReader in(path);
  operators::Opening opening = read_opening(message, in);
  if (!in.status().ok()) return in.status();
  return opening;
}

std::shared_ptr<const Operator> read_operator(const v1::Node& message, FieldReader& in) {
  std::optional<Operator> op = read_kind(message, in);
  return op ? std::make_shared<const Operator>(*std::move(op)) : nullptr;
}

OperandCount operand_count(const Operator& op) {
  switch (op.kind) {
    case Kind::kDifference:
      return {2};
    case Kind::kBt2:
      return {2, 2};
    case Kind::kSuperelliptic:
    case Kind::kBtk:
      if (op.by_angle) return {2, 2};
      if (op.terms.size() > 1) return {op.terms.size(), op.terms.size()};
      return {2, kMaxOperands};
    default:
      return {op.form == operators::Form::kDifference ? 2u : 1u};
  }
}

}  // namespace isofield::blobtree
