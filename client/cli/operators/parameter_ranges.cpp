#include "operators/parameter_ranges.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <vector>

namespace isofield {
namespace {

constexpr char kLength[] = "a length > 0";
constexpr char kLengths[] = "lengths > 0: one for each child, or one for all";
constexpr char kExponent[] = "a number within [1, 64]";
constexpr char kTangent[] = "degrees within [0, 45]";
constexpr char kOmega[] = "a number within [0.001, 1]";

// The ranges by "Message.field".
const absl::flat_hash_map<std::string, ParameterRange>& ranges() {
  static const auto* const kRanges = new absl::flat_hash_map<std::string, ParameterRange>{
      {"Ricci.exponent", {kExponent, ""}},
      {"GradientBlend.volume", {"0 for profiles of one variable, or 16, 32, 64 or 128 samples a side", "0"}},
      {"Opening.preset", {"", "camel, where no other parameter of the opening is stated"}},
      {"Opening.alpha0", {"degrees within [0, 180], below alpha1", "the preset's: camel 0, organic 0, contact 0"}},
      {"Opening.alpha1", {"degrees between alpha0 and alpha2", "the preset's: camel 90, organic 60, contact 90"}},
      {"Opening.alpha2",
       {"degrees within [0, 180], above alpha1", "the preset's: camel 180, organic 135, contact 180"}},
      {"Opening.theta0", {kTangent, "the preset's: camel 45, organic 30, contact 0"}},
      {"Opening.theta1", {kTangent, "the preset's: camel 0, organic 0, contact 18"}},
      {"Opening.theta2", {kTangent, "the preset's: camel 45, organic 45, contact 45"}},
      {"Opening.w0", {"a slope within [0.05, 20]", "the preset's: camel 1, organic 3, contact 1"}},
      {"Opening.w1", {"a slope within [0.05, 20]", "the preset's: camel 1, organic 1, contact 0.7"}},
      {"Opening.samples",
       {"3 to 4096 degrees within [0, 45], at even angles from 0 to 180 degrees, instead of all other parameters of "
        "the opening",
        "none"}},
      {"Silhouette.kind", {"", "smooth, or sampled where there are samples"}},
      {"Silhouette.k", {"a strength within [0, 1], of a bulge only", "0"}},
      {"Silhouette.samples",
       {"3 to 4096 distances from the origin at even angles from 0 to 90 degrees, the first and the last 1, of a "
        "sampled silhouette only",
        "none"}},
      {"BartheBlend.theta1", {kTangent, "0"}},
      {"BartheBlend.theta2", {kTangent, "0"}},
      {"BernhardtBlend.theta1", {kTangent, "0"}},
      {"BernhardtBlend.theta2", {kTangent, "0"}},
      {"BernhardtBlend.weight", {"a number within [0, 1]", "0"}},
      {"PaskoBlend.a0", {"a number; a negative one adds material", "0"}},
      {"PaskoBlend.a1", {kLength, ""}},
      {"PaskoBlend.a2", {kLength, ""}},
      {"SuperellipticBlend.exponent", {kExponent, ""}},
      {"SuperellipticBlend.ranges", {kLengths, ""}},
      {"SuperellipticBlend.by_angle", {"", "false"}},
      {"SuperellipticBlend.omega", {kOmega, "0.01"}},
      {"FunctionalBlend.x", {"2 to 256 numbers, the first >= 0 and each above the one before", ""}},
      {"FunctionalBlend.h", {"as many numbers as x has", ""}},
      {"Bt2.r1", {kLength, ""}},
      {"Bt2.r2", {kLength, ""}},
      {"Bt2.p", {"a number below r1 r2, and at least -1e14 r1 r2", "0"}},
      {"Bt2.m1", {"a number within [0.001, 1000]", "1"}},
      {"Bt2.m2", {"a number within [0.001, 1000]", "1"}},
      {"Bt2.eliminate_bulge", {"", "false"}},
      {"Bt2.omega", {kOmega, "0.01"}},
      {"Btk.ranges", {kLengths, ""}},
      {"Btk.powers", {"numbers within ]1, 64]: one for each child, or one for all", "2"}},
      {"Btk.weights", {"numbers within [0.001, 1000]: one for each child, or one for all", "1"}},
      {"Btk.eliminate_bulge", {"", "false"}},
      {"Btk.omega", {kOmega, "0.01"}},
      {"SampledOperator.size", {"samples a side within [2, 128]", ""}},
      {"SampledOperator.values", {"size^3 numbers, f1 fastest, then f2, then theta", ""}},
  };
  return *kRanges;
}

std::string choices(const google::protobuf::EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(absl::AsciiStrToLower(type.value(i)->name()));
  }
  return absl::StrCat("one of ", absl::StrJoin(names, ", "));
}

}  // namespace

ParameterRange range_of(const google::protobuf::FieldDescriptor& field) {
  using google::protobuf::FieldDescriptor;
  const auto found = ranges().find(absl::StrCat(field.containing_type()->name(), ".", field.name()));
  ParameterRange range;
  if (found != ranges().end()) range = found->second;
  if (field.name() == "form") range.otherwise = "union";
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) range.accepts = choices(*field.enum_type());
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) range.accepts = "true or false";
  return range;
}

}  // namespace isofield
