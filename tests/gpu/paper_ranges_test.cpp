// Tests what [H] promises of blends with individual ranges: weights m_i leave the surface alone, and decide only the
// range with which a later blend meets each primitive.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "gpu/device_field.h"
#include "gpu/operator_cases.h"
#include "support/paper_scene.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using operators::Form;
using operators::Kind;
using operators::Operator;
using reference::Evaluator;
using test_support::figure;
using test_support::keep_worst;
using test_support::Random;

struct Family {
  const char* name;
  Kind kind;
  std::size_t operands;
};
constexpr Family kFamilies[] = {
    {"bt2", Kind::kBt2, 2}, {"btk of 2", Kind::kBtk, 2}, {"btk of 3", Kind::kBtk, 3}, {"btk of 5", Kind::kBtk, 5}};

// Returns an operator with random ranges, powers, conics and weights.
Operator random_operator(const Family& family, Random& random) {
  std::vector<operators::Term> terms;
  for (std::size_t i = 0; i < family.operands; ++i) {
    terms.push_back({random.number(0.2, 2), random.number(1.2, 5), std::pow(10, random.number(-1, std::log10(4.0)))});
  }
  const double conic = random.number(-2, 0.95) * terms[0].range * terms[1].range;
  if (family.kind == Kind::kBt2) return operators::Bt2{{terms[0], terms[1]}, conic, {}};
  return operators::Btk{terms, {}};
}

// Returns rows of fields within and around the ranges.
std::vector<float> random_rows(const Operator& op, Random& random, int rows) {
  std::vector<float> x;
  for (int i = 0; i < rows; ++i) {
    for (const operators::Term& t : terms_of(op)) x.push_back(static_cast<float>(random.number(-1, 1.5) * t.range));
  }
  return x;
}

// Calls test(operator, arguments, the device's results) for `sets` operators of a family, with `rows` points each.
template <class Test>
void for_random_operators(const Family& family, int sets, int rows, const Test& test) {
  Random random(41);
  for (int set = 0; set < sets; ++set) {
    const Operator op = random_operator(family, random);
    const std::vector<float> x = random_rows(op, random, rows);
    test(op, x, on_device({family.name, op, family.operands}, x));
  }
}

// Half of the random points are moved to within 1e-4 of the surface.
TEST(PaperRanges, WeightsDoNotMoveTheZeroSet) {
  constexpr int kSets = 25, kRows = 10'000;
  std::size_t all = 0;
  Random random(41);
  for (const Family& family : kFamilies) {
    const std::size_t k = family.operands;
    int near = 0, differ_near = 0, differ = 0;
    for (int set = 0; set < kSets; ++set) {
      const Operator op = random_operator(family, random);
      Operator even = op;
      for (operators::Term& t : terms_of(even)) t.weight = 1;
      std::vector<float> x = random_rows(op, random, kRows);
      const std::vector<float> levels = on_device({family.name, even, k}, x);
      for (std::size_t i = 0; i < kRows; i += 2) {
        // If every x_i is less by h, the level is less by h.
        const double move = random.number(-1e-4, 1e-4) - levels[i * (1 + k)];
        for (std::size_t c = 0; c < k; ++c) x[i * k + c] = static_cast<float>(x[i * k + c] + move);
      }
      const std::vector<float> a = on_device({family.name, op, k}, x), b = on_device({family.name, even, k}, x);
      for (std::size_t i = 0; i < a.size(); i += 1 + k) {
        ASSERT_TRUE(std::isfinite(a[i]) && std::isfinite(b[i])) << family.name;
        const bool is_near = std::min(std::abs(a[i]), std::abs(b[i])) < 1e-6f;
        const bool differs = (a[i] < 0) != (b[i] < 0);
        near += is_near;
        (is_near ? differ_near : differ) += differs;
        ++all;
      }
    }
    figure(absl::StrCat(family.name, ": points within 1e-6 of the surface"), near);
    figure(absl::StrCat(family.name, ": of those, of different sign"), differ_near);
    figure(absl::StrCat(family.name, ": farther points of different sign"), differ);
    EXPECT_EQ(differ, 0) << family.name;
    EXPECT_GT(near, 1000) << family.name << ": the points test nothing near the surface";
  }
  figure("points in all", static_cast<double>(all));
  EXPECT_EQ(all, 1'000'000u);
}

// The least x_i / m_i, and whether the operator blends there: in [H] region II of bt2, and for btk where another
// bracket than the least field's one is positive.
struct Least {
  double value = 0;
  bool is_blend = false;
};
Least least(const Operator& op, const float* x) {
  const std::span<const operators::Term> terms = terms_of(op);
  const std::size_t k = terms.size();
  std::size_t at = 0;
  for (std::size_t i = 1; i < k; ++i) {
    if (x[i] / terms[i].weight < x[at] / terms[at].weight) at = i;
  }
  const double h = x[at] / terms[at].weight;
  if (op.kind() == Kind::kBt2) {
    const double m1 = terms[0].weight, m2 = terms[1].weight;
    return {h, m2 * x[0] - m1 * (x[1] - terms[1].range) > 0 && m2 * (x[0] - terms[0].range) - m1 * x[1] < 0};
  }
  bool is_blend = false;
  for (std::size_t i = 0; i < k; ++i) {
    is_blend |= i != at && terms[i].range - x[i] + terms[i].weight * h > 0;
  }
  return {h, is_blend};
}

TEST(PaperRanges, OutsideTheBlendALevelIsTheLeastField) {
  for (const Family& family : kFamilies) {
    int outside = 0, same_bits = 0, inside = 0, clear = 0, below = 0;
    double most_off = 0, most_above = -1;
    for_random_operators(family, 10, 10'000, [&](const Operator& op, const std::vector<float>& x, const auto& results) {
      for (std::size_t i = 0; i * family.operands < x.size(); ++i) {
        const Least l = least(op, &x[i * family.operands]);
        const float g = results[i * (1 + family.operands)];
        const double scale = std::max(1.0, std::abs(l.value));
        if (l.is_blend) {
          ++inside;
          // At its beginning the blend is below the least field by less than float32's rounding.
          const double exact_g =
              exact(op, {&x[i * family.operands], &x[i * family.operands] + family.operands}).field.v;
          EXPECT_LE(exact_g, l.value + 1e-14 * scale) << family.name;
          if (exact_g < l.value - 1e-6 * scale) {
            ++clear;
            below += g < static_cast<float>(l.value);
          }
          keep_worst(most_above, (g - l.value) / scale);
        } else {
          ++outside;
          same_bits += g == static_cast<float>(l.value);
          keep_worst(most_off, std::abs(g - l.value) / scale);
        }
      }
    });
    figure(absl::StrCat(family.name, ": points outside"), outside);
    figure(absl::StrCat(family.name, ": there off min x/m by at most"), most_off);
    figure(absl::StrCat(family.name, ": there the same to the bit"), 100.0 * same_bits / outside, "%");
    figure(absl::StrCat(family.name, ": points inside"), inside);
    figure(absl::StrCat(family.name, ": there below it by more than 1e-6"), clear);
    figure(absl::StrCat(family.name, ": of those, below it on the device"), 100.0 * below / clear, "%");
    figure(absl::StrCat(family.name, ": there above it by at most"), most_above);
    EXPECT_LE(most_off, 1e-6) << family.name;
    EXPECT_LE(most_above, 1e-6) << family.name;
    EXPECT_EQ(below, clear) << family.name;
    EXPECT_GE(clear, 0.9 * inside) << family.name;
    EXPECT_GT(std::min(outside, inside), 1000) << family.name;
  }
}

TEST(PaperRanges, WithWeightsOfOneTheLeastFieldIsKeptToTheBit) {
  for (const Family& family : kFamilies) {
    int outside = 0;
    Random random(43);
    for (int set = 0; set < 5; ++set) {
      Operator op = random_operator(family, random);
      for (operators::Term& t : terms_of(op)) t.weight = 1;
      const std::vector<float> x = random_rows(op, random, 10'000);
      const std::vector<float> results = on_device({family.name, op, family.operands}, x);
      for (std::size_t i = 0; i * family.operands < x.size(); ++i) {
        const Least l = least(op, &x[i * family.operands]);
        if (l.is_blend) continue;
        ++outside;
        EXPECT_EQ(results[i * (1 + family.operands)], static_cast<float>(l.value)) << family.name;
      }
    }
    figure(absl::StrCat(family.name, ": points outside"), outside);
    EXPECT_GT(outside, 1000) << family.name;
  }
}

// In [H] eqs. 2 and 3 the level line h is the zero set moved by (m_1 h, ..., m_k h).
TEST(PaperRanges, LevelsAreTheZeroSetMovedByTheWeights) {
  for (const Family& family : kFamilies) {
    double worst = 0;
    for_random_operators(family, 10, 4'000, [&](const Operator& op, const std::vector<float>& x, const auto& results) {
      constexpr float kLevel = 0.25f;
      std::vector<float> moved = x;
      for (std::size_t i = 0; i < x.size(); ++i) {
        moved[i] += static_cast<float>(terms_of(op)[i % family.operands].weight) * kLevel;
      }
      const std::vector<float> at_moved = on_device({family.name, op, family.operands}, moved);
      for (std::size_t i = 0; i < results.size(); i += 1 + family.operands) {
        const float expected = results[i] + kLevel;
        keep_worst(worst, std::abs(at_moved[i] - expected) / std::max(1.0f, std::abs(expected)));
      }
    });
    figure(absl::StrCat(family.name, ": B(x + m h) off B(x) + h by at most"), worst);
    EXPECT_LE(worst, 3e-6) << family.name;
  }
}

std::uint32_t bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

TEST(PaperRanges, FormsOfOneBlendAreDeMorgans) {
  std::size_t compared = 0;
  for (const Family& family : kFamilies) {
    for_random_operators(family, 4, 5'000, [&](Operator op, const std::vector<float>& x, const auto&) {
      const auto values = [&](Form form, const std::vector<float>& arguments) {
        op.form = form;
        const std::vector<float> results = on_device({family.name, op, family.operands}, arguments);
        std::vector<float> g;
        for (std::size_t i = 0; i < results.size(); i += 1 + family.operands) g.push_back(results[i]);
        return g;
      };
      std::vector<float> negated = x, first_negated = x;
      for (std::size_t i = 0; i < x.size(); ++i) {
        negated[i] = -x[i];
        if (i % family.operands == 0) first_negated[i] = -x[i];
      }
      const std::vector<float> intersection = values(Form::kIntersection, x), dual = values(Form::kUnion, negated);
      const std::vector<float> difference = values(Form::kDifference, x);
      const std::vector<float> dual_difference = values(Form::kUnion, first_negated);
      for (std::size_t i = 0; i < dual.size(); ++i) {
        ASSERT_EQ(bits(intersection[i]), bits(-dual[i])) << family.name;
        ASSERT_EQ(bits(difference[i]), bits(-dual_difference[i])) << family.name;
        compared += 2;
      }
    });
  }
  figure("identities that hold to the bit", static_cast<double>(compared));
  EXPECT_EQ(compared, std::size(kFamilies) * 4 * 5'000 * 2);
}

std::string signed_segment(const std::string& name, const dvec3& a, const dvec3& b, double radius) {
  return absl::StrCat(R"({"name": ")", name, R"(", "segment": {"a": [)", a.x, ",", a.y, ",", a.z, R"(], "b": [)", b.x,
                      ",", b.y, ",", b.z, R"(], "radius_a": )", radius, R"(, "radius_b": )", radius,
                      R"(, "law": "SIGNED"}})");
}

std::string signed_cylinder(const std::string& name, const dvec3& a, const dvec3& b, double radius) {
  return absl::StrCat(R"({"name": ")", name, R"(", "cylinder": {"a": [)", a.x, ",", a.y, ",", a.z, R"(], "b": [)", b.x,
                      ",", b.y, ",", b.z, R"(], "radius": )", radius, R"(, "law": "SIGNED"}})");
}

v1::Scene scene(const std::string& nodes) {
  return test_support::scene_of_nodes("[" + nodes + "]");
}
Evaluator exact_scene(const std::string& nodes) {
  return Evaluator(test_support::read_or_die(scene(nodes)));
}

// Two crossing rods along x and y, blended with the weights 1 and `m`. A post along z stands on one of them, far from
// the other, and is blended on with a range of 0.4.
struct Post {
  static constexpr double kRodRadius = 0.3, kPostRadius = 0.2, kRange = 0.4, kAway = 3;
  bool on_first;
  std::string post, all;

  Post(const char* kind, double m, bool on_first) : on_first(on_first) {
    const dvec3 foot = along(kAway);
    const std::string rods = signed_segment("first", {-6, 0, 0}, {6, 0, 0}, kRodRadius) + "," +
                             signed_segment("second", {0, -6, 0}, {0, 6, 0}, kRodRadius);
    post = signed_segment("post", foot, foot + dvec3{0, 0, 3}, kPostRadius);
    const std::string bt2 = R"("bt2": {"r1": 0.4, "r2": 0.4)", btk = R"("btk": {"ranges": [0.4])";
    const bool is_bt2 = std::string(kind) == "bt2";
    all = absl::StrCat(rods, ",", post, R"(, {"name": "rods", )",
                       is_bt2 ? absl::StrCat(bt2, R"(, "m2": )", m) : absl::StrCat(btk, R"(, "weights": [1, )", m, "]"),
                       R"(, "children": ["first", "second"]}}, {)", is_bt2 ? bt2 : btk,
                       R"(, "children": ["rods", "post"]}})");
  }
  dvec3 along(double t) const { return on_first ? dvec3{t, 0, 0} : dvec3{0, t, 0}; }
  // on_post() is a point at a height above the rod, on_rod() one at a distance from the post.
  dvec3 on_post(double height) const { return along(kAway + kPostRadius) + dvec3{0, 0, kRodRadius + height}; }
  dvec3 on_rod(double distance) const { return along(kAway + kPostRadius + distance) + dvec3{0, 0, kRodRadius}; }
};

// Returns how far out an edge is: the least t beyond which nothing is changed.
double edge(const std::function<bool(double)>& is_changed) {
  double low = 0.01, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (is_changed(middle) ? low : high) = middle;
  }
  return high;
}

TEST(PaperRanges, ALaterBlendMeetsAPrimitiveWithItsOwnRange) {
  for (const char* kind : {"bt2", "btk"}) {
    for (const double m : {1.0, 0.3, 2.0}) {
      for (const bool on_first : {true, false}) {
        const Post p(kind, m, on_first);
        const double mine = on_first ? 1 : m;
        const Evaluator all = exact_scene(p.all), post = exact_scene(p.post);
        const double along_post =
            edge([&](double t) { return all.value(p.on_post(t)) < post.value(p.on_post(t)) - 1e-14; });
        const double along_rod = edge([&](double t) { return all.value(p.on_rod(t)) < -1e-14; });
        // The device finds the same edge at 2,000 heights: it is the greatest height at which the post has moved.
        const DeviceField device_all(scene(p.all)), device_post(scene(p.post));
        std::vector<dvec3> points;
        for (int i = 1; i <= 2000; ++i) points.push_back(p.on_post(i / 2000.0));
        const std::vector<double> moved = device_all.values(points), alone = device_post.values(points);
        double device_edge = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (moved[i] < alone[i] - 2e-7) device_edge = static_cast<double>(i + 1) / 2000;
        }
        const std::string what = absl::StrCat(kind, ", post on the ", on_first ? "first" : "second", ", m = ", mine);
        figure(what + ": reaches along the post", along_post);
        figure(what + ": reaches along the rod", along_rod);
        figure(what + ": reaches along the post, device", device_edge);
        EXPECT_NEAR(along_post, Post::kRange * mine, 1e-5) << what;
        EXPECT_NEAR(along_rod, Post::kRange, 1e-5) << what;
        // The blend leaves the post's surface like a parabola, so a move of 2e-7 is 0.001 from its edge.
        EXPECT_NEAR(device_edge, Post::kRange * mine, 4e-3) << what;
      }
    }
  }
}

// The wheel of [H] fig. 9: one BTk joins hub and six spokes, another one joins the rim. The spokes' weight is m.
struct Wheel {
  std::string nodes;
  v1::Scene message;
  Evaluator exact;

  explicit Wheel(double m) : nodes(text(m)), message(scene(nodes)), exact(exact_scene(nodes)) {}

  static dvec3 spoke_end(int i) {
    const double angle = std::numbers::pi / 3 * i;
    return {1.62 * std::cos(angle), 1.62 * std::sin(angle), 0};
  }
  static std::string text(double m) {
    std::string all = signed_cylinder("hub", {0, 0, -0.34}, {0, 0, 0.34}, 0.42), names = R"("hub")", weights = "1";
    for (int i = 0; i < 6; ++i) {
      const std::string name = absl::StrCat("spoke/", i);
      absl::StrAppend(&all, ",", signed_cylinder(name, {0, 0, 0}, spoke_end(i), 0.15));
      absl::StrAppend(&names, ", \"", name, "\"");
      absl::StrAppend(&weights, ", ", m);
    }
    return absl::StrCat(all, R"(, {"name": "rim", "torus": {"major_radius": 1.75, "minor_radius": 0.2,
        "law": "SIGNED"}}, {"name": "inside", "btk": {"children": [)",
                        names, R"(], "ranges": [0.35], "weights": [)", weights,
                        R"(]}}, {"btk": {"children": ["inside", "rim"], "ranges": [0.42]}})");
  }
};

// Returns the point of the surface to which descent along the gradient leads.
dvec3 onto(const Evaluator& surface, dvec3 p) {
  for (int i = 0; i < 30; ++i) {
    const reference::Sample s = surface.evaluate(p);
    p = p - s.gradient * (s.value / std::max(dot(s.gradient, s.gradient), 1e-6));
    if (std::abs(s.value) < 1e-14) break;
  }
  return p;
}

TEST(PaperRanges, WeightsOfAWheelsSpokesChangeItsOuterJointsOnly) {
  const Wheel even(1), less(0.3);
  const Evaluator rim = exact_scene(R"({"torus": {"major_radius": 1.75, "minor_radius": 0.2, "law": "SIGNED"}})");
  const engine::Mesh mesh = DeviceField(even.message).mesh(0.06);
  constexpr double kSize = 2 * (1.75 + 0.2), kRange = 0.42;
  std::vector<dvec3> away;  // on the even wheel
  double most_away = 0, most_at_joints = 0;
  std::size_t at_joints = 0;
  for (std::size_t v = 0; v + 2 < mesh.positions.size(); v += 3) {
    const dvec3 p = onto(even.exact, {mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]});
    const double distance = length(onto(less.exact, p) - p);
    // An outer joint is within the blend's range of the rim and of a spoke.
    double to_spoke = 10;
    for (int i = 0; i < 6; ++i) {
      const dvec3 axis = Wheel::spoke_end(i) * (1 / 1.62);
      const dvec3 to_axis = p - axis * std::clamp(dot(p, axis), 0.0, 1.62);
      to_spoke = std::min(to_spoke, length(to_axis) - 0.15);
    }
    if (rim.value(p) < kRange && to_spoke < kRange) {
      ++at_joints;
      most_at_joints = std::max(most_at_joints, distance);
    } else {
      away.push_back(rounded_to_float(p));
      most_away = std::max(most_away, distance);
    }
  }
  // On the device the distance is measured to first order.
  double most_device = 0;
  for (const reference::Sample& s : DeviceField(less.message).samples(away)) {
    most_device = std::max(most_device, std::abs(s.value) / length(s.gradient));
  }
  figure("vertices away from the outer joints", static_cast<double>(away.size()));
  figure("vertices at the outer joints", static_cast<double>(at_joints));
  figure("away: surfaces differ by at most, of the size", most_away / kSize);
  figure("away: on the device", most_device / kSize);
  figure("at the joints: surfaces differ by at most, of the size", most_at_joints / kSize);
  figure("at the joints: surfaces differ by at most, of the rim's radius", most_at_joints / 0.2);
  EXPECT_LE(most_away, 1e-4 * kSize);
  EXPECT_LE(most_device, 1e-4 * kSize);
  EXPECT_GE(most_at_joints, 0.01 * kSize);
  EXPECT_GT(away.size(), 2000u);
  EXPECT_GT(at_joints, 500u);
}

// Returns how far a ray from within goes, relative to `radius`, less 1.
double growth(const Evaluator& e, const dvec3& origin, const dvec3& direction, double radius) {
  const auto t = test_support::exit_distance([&](const dvec3& p) { return -e.value(p); }, origin, direction, 2, 400, 0);
  return t ? *t / radius - 1 : std::nan("");
}

std::string eliminating(const char* kind, bool eliminates) {
  return absl::StrCat(std::string(kind) == "bt2" ? R"({"bt2": {"r1": 0.3, "r2": 0.3)" : R"({"btk": {"ranges": [0.3])",
                      R"(, "children": ["left", "right"], "eliminate_bulge": )", eliminates ? "true" : "false", "}}");
}

TEST(PaperRanges, BulgeEliminationKeepsTheRadiusOfAlignedCylinders) {
  constexpr double kRadius = 0.3;
  for (const char* kind : {"bt2", "btk"}) {
    for (const bool is_flat : {false, true}) {
      const auto make = is_flat ? signed_cylinder : signed_segment;
      const std::string aligned =
          make("left", {-2, 0, 0}, {0.5, 0, 0}, kRadius) + "," + make("right", {-0.5, 0, 0}, {2, 0, 0}, kRadius);
      for (const bool eliminates : {false, true}) {
        const std::string nodes = aligned + "," + eliminating(kind, eliminates);
        const Evaluator e = exact_scene(nodes);
        // Errors are measured where the cylinders overlap, and inside beyond the ends.
        double overlap = 0, beyond = 0;
        std::vector<dvec3> surface;
        for (int i = -150; i <= 150; ++i) {
          const double x = 0.01 * i, g = growth(e, {x, 0, 0}, {0, 0.6, 0.8}, kRadius);
          double& most = std::abs(x) <= 0.5 ? overlap : beyond;
          most = std::max(most, std::abs(g));
          surface.push_back(rounded_to_float(dvec3{x, 0, 0} + dvec3{0, 0.6, 0.8} * (kRadius * (1 + g))));
        }
        double device_off = 0;
        for (const double g : DeviceField(scene(nodes)).values(surface)) device_off = std::max(device_off, std::abs(g));
        const std::string what = absl::StrCat(kind, is_flat ? ", flat ends" : ", round ends",
                                              eliminates ? ", with elimination" : ", without");
        figure(what + ": radius off where they overlap", 100 * overlap, "%");
        figure(what + ": radius off beyond the inner ends", 100 * beyond, "%");
        figure(what + ": device's value on that surface at most", device_off);
        EXPECT_LE(device_off, 2e-6) << what;
        if (eliminates) {
          EXPECT_LE(overlap, 0.01) << what;
          // A flat end meets the other cylinder's side at a right angle, so the blend treats it as a joint.
          if (!is_flat) {
            EXPECT_LE(beyond, 0.01) << what;
          }
        } else {
          EXPECT_GT(overlap, 0.1) << what;
        }
      }
    }
    // The cylinders cross here. The figure is how far the blend goes out along the bisector from the edge of the union.
    const std::string crossing = signed_segment("left", {-2, 0, 0}, {2, 0, 0}, kRadius) + "," +
                                 signed_segment("right", {0, -2, 0}, {0, 2, 0}, kRadius);
    const double edge_of_union = kRadius * std::numbers::sqrt2;
    double out[2];
    for (const bool eliminates : {false, true}) {
      out[eliminates] = growth(exact_scene(crossing + "," + eliminating(kind, eliminates)), {0, 0, 0},
                               {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0}, edge_of_union);
      figure(absl::StrCat(kind, ", crossing, ", eliminates ? "with" : "without", ": edge moved out by"),
             100 * out[eliminates], "%");
    }
    EXPECT_GT(out[1], 0.5 * out[0]);
    EXPECT_GT(out[1], 0.1);
  }
}

}  // namespace
}  // namespace isofield::gpu_test
