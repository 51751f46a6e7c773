#include "operators/reading.h"

#include <absl/strings/str_cat.h>

#include <numbers>

#include "isofield/v1/scene.pb.h"

namespace isofield::operators {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr int kLeastSamples = 3, kMostSamples = 4096;

}  // namespace

std::string element_name(absl::string_view field, int i) {
  return absl::StrCat(field, "[", i, "]");
}

Form read_form(int form, base::FieldReader& in) {
  switch (form) {
    case v1::FORM_UNSPECIFIED:
    case v1::UNION:
      return Form::kUnion;
    case v1::INTERSECTION:
      return Form::kIntersection;
    case v1::DIFFERENCE:
      return Form::kDifference;
    default:
      in.refuse("form", absl::StrCat(form), "UNION, INTERSECTION or DIFFERENCE");
      return Form::kUnion;
  }
}

double read_tangent_angle(absl::string_view field, double degrees, base::FieldReader& in) {
  return in.number(field, degrees, 0, 45, "degrees within [0, 45]") * kRadians;
}

std::vector<double> read_samples(absl::string_view field, const base::FieldReader::Numbers& numbers, double least,
                                 double most, double unit, absl::string_view expected, base::FieldReader& in) {
  if (numbers.size() < kLeastSamples || numbers.size() > kMostSamples) {
    in.refuse_count(field, numbers.size(), absl::StrCat(kLeastSamples, " to ", kMostSamples, " samples"));
    return {0, 0};
  }
  std::vector<double> samples;
  for (int i = 0; i < numbers.size(); ++i) {
    samples.push_back(in.number(element_name(field, i), numbers[i], least, most, expected) * unit);
  }
  return samples;
}

Opening read_opening(const v1::Opening& m, base::FieldReader& in) {
  Opening o = camel();
  if (m.preset() == v1::Opening::ORGANIC) o = organic();
  if (m.preset() == v1::Opening::CONTACT) o = contact();
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
    // The parameters stay 0, so that equal samples make equal openings.
    o = {};
    o.samples =
        SampledCurve::even(0, std::numbers::pi,
                           read_samples("opening.samples", m.samples(), 0, 45, kRadians, "degrees within [0, 45]", in));
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
  constexpr double kLeast = kLeastRamp * (1 - 1e-9);
  const std::string by = absl::StrCat("by ", kLeastRamp / kRadians, " (a thousandth of a radian) or more");
  if (!(o.alpha1 - o.alpha0 >= kLeast)) {
    in.refuse("opening.alpha1", degrees(o.alpha1), absl::StrCat("more than alpha0 = ", degrees(o.alpha0), ", ", by));
  }
  if (!(o.alpha2 - o.alpha1 >= kLeast)) {
    in.refuse("opening.alpha2", degrees(o.alpha2), absl::StrCat("more than alpha1 = ", degrees(o.alpha1), ", ", by));
  }
  return o;
}

}  // namespace isofield::operators
