#include "support/paper_scene.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <iostream>

namespace isofield::test_support {
namespace {

using blobtree::dvec3;

std::string list(const dvec3& v) {
  return absl::StrFormat("[%.17g, %.17g, %.17g]", v.x, v.y, v.z);
}

std::string range(double R) {
  return absl::StrFormat(R"("range": %.17g)", (1 - kSoftRadius) * R);
}

}  // namespace

std::string soft_sphere(const std::string& name, const dvec3& centre, double R) {
  return absl::StrFormat(R"({"name": "%s", "sphere": {"center": %s, "radius": %.17g, %s}})", name, list(centre),
                         kSoftRadius * R, range(R));
}

std::string soft_segment(const std::string& name, const dvec3& a, const dvec3& b, double R) {
  return absl::StrFormat(R"({"name": "%s", "segment": {"a": %s, "b": %s, "radius_a": %.17g, "radius_b": %.17g, %s}})",
                         name, list(a), list(b), kSoftRadius * R, kSoftRadius * R, range(R));
}

std::string soft_torus(const std::string& name, double major_radius, double R) {
  return absl::StrFormat(R"({"name": "%s", "torus": {"major_radius": %.17g, "minor_radius": %.17g, %s}})", name,
                         major_radius, kSoftRadius * R, range(R));
}

const char* text(Join join) {
  switch (join) {
    case Join::kSum:
      return "sum";
    case Join::kMax:
      return "union";
    case Join::kCamel:
      return "camel";
    case Join::kOrganic:
      return "organic";
    case Join::kContact:
      return "contact";
  }
  return "";
}

std::string join_node(Join join, const std::vector<std::string>& children, const std::string& name) {
  const std::string names =
      absl::StrCat("\"children\": [",
                   absl::StrJoin(children, ", ",
                                 [](std::string* out, const std::string& c) { absl::StrAppend(out, "\"", c, "\""); }),
                   "]");
  const std::string head = name.empty() ? "{" : absl::StrCat("{\"name\": \"", name, "\", ");
  switch (join) {
    case Join::kSum:
      return absl::StrCat(head, "\"sum\": {", names, "}}");
    case Join::kMax:
      return absl::StrCat(head, "\"max\": {", names, "}}");
    case Join::kCamel:
      return absl::StrCat(head, "\"gradient\": {", names, R"(, "opening": {"preset": "CAMEL"}}})");
    case Join::kOrganic:
      return absl::StrCat(head, "\"gradient\": {", names, R"(, "opening": {"preset": "ORGANIC"}}})");
    case Join::kContact:
      return absl::StrCat(head, "\"gradient\": {", names,
                          R"(, "opening": {"preset": "CONTACT"}, "silhouette": {"kind": "BULGE", "k": 0.8}}})");
  }
  return "";
}

std::optional<double> exit_distance(const Field& f, const dvec3& origin, const dvec3& direction, double reach,
                                    int steps, double iso) {
  const auto above = [&](double t) { return f(origin + direction * t) > iso; };
  if (!above(0)) return std::nullopt;
  for (int i = 1; i <= steps; ++i) {
    double low = reach * (i - 1) / steps, high = reach * i / steps;
    if (above(high)) continue;
    for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2) {
      (above(middle) ? low : high) = middle;
    }
    return low;
  }
  return std::nullopt;
}

void figure(const std::string& what, double value, const std::string& unit) {
  const std::string number = absl::StrFormat("%.4g", value);
  std::cout << "  " << what << ": " << number << (unit.empty() ? "" : " ") << unit << "\n";
  std::string key = what;
  for (char& c : key) {
    if (c == ' ') c = '_';
  }
  testing::Test::RecordProperty(key, unit.empty() ? number : absl::StrCat(number, " ", unit));
}

}  // namespace isofield::test_support
