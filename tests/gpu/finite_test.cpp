// Tests that values and gradients are finite: those of single operators at the ends of float32, and those of scenes at
// the ends of what parameters and points may be.
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"
#include "engine/points/field_evaluator.h"
#include "gpu/gpu_environment.h"
#include "gpu/operator_cases.h"
#include "support/paper_scene.h"
#include "support/primitive_nodes.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using operators::Form;
using operators::Kind;
using operators::Law;
using operators::Operator;
using test_support::Random;

constexpr float kMost = std::numeric_limits<float>::max();

// Returns the cases, with the gradient blend's own representations and some extreme parameters.
std::vector<Case> all_cases() {
  std::vector<Case> all = cases();
  using namespace operators;
  for (const Form form : {Form::kUnion, Form::kIntersection, Form::kDifference}) {
    all.push_back({"gradient", Operator(Gradient{}, form)});
    all.push_back({"bulge", Operator(Gradient{.silhouette = {Silhouette::Kind::kBulge, 0.8}}, form)});
  }
  all.push_back({"volume", Gradient{.volume = 16}});
  for (const double tightness : {1e-9, 1e14}) {
    all.push_back({absl::StrCat("bt2 of tightness ", tightness),
                   Bt2{{Term{1e-3, 2, 1e-3}, Term{1e3, 2, 1e3}}, 1 - tightness, {}}});
  }
  const std::vector<Term> far_apart{{1e-9, 2, 1}, {1e9, 2, 1}};
  all.push_back({"superelliptic, extreme", Superelliptic{64, far_apart, {}}});
  all.push_back({"superelliptic by angle, extreme", Superelliptic{64, far_apart, {.is_on = true, .omega = 0.001}}});
  all.push_back({"btk, extreme", Btk{{{1e-9, 64, 1e-3}, {1e9, 1.0001, 1e3}}, {}}});
  all.push_back({"pasko, extreme", Pasko{-1e9, 1e-9, 1e9}});
  return all;
}

TEST(Finite, OperatorsAreAtTheEndsOfFloat32) {
  std::vector<float> fields{0,      std::numeric_limits<float>::denorm_min(),
                            1e-38f, 1e-20f,
                            1e-7f,  0.5f,
                            1,      3,
                            1e7f,   1e12f,
                            1e19f,  1e25f,
                            1e30f,  1e36f};
  std::size_t rows_in_all = 0;
  for (const Case& c : all_cases()) {
    std::vector<float> values = fields;
    if (c.op.law() == Law::kSigned) {
      for (const float f : fields) values.push_back(-f);
    }
    std::vector<float> rows;
    for (const float x1 : values) {
      for (const float x2 : values) {
        for (int variant = 0; variant < 3; ++variant) {
          if (c.operands == 3) {
            rows.insert(rows.end(), {x1, x2, variant == 0 ? x1 : variant == 1 ? 0.0f : -x2});
          } else if (c.op.has_angular_ranges()) {
            const float ratios[] = {1e-38f, 1.0f, kMost};
            rows.insert(rows.end(), {x1, x2, variant * 1.5707963f, ratios[variant]});
          } else if (c.op.is_steered()) {
            rows.insert(rows.end(), {x1, x2, variant * 0.3926990f});
          } else if (variant == 0) {
            rows.insert(rows.end(), {x1, x2});
          }
        }
      }
    }
    const std::vector<float> results = on_device(c, rows);
    const std::size_t columns = c.operands + (c.op.has_angular_ranges() ? 2 : c.op.is_steered() ? 1 : 0);
    const std::size_t width = results.size() / (rows.size() / columns);
    rows_in_all += rows.size() / columns;
    int bad = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (std::isfinite(results[i])) continue;
      if (++bad > 3) continue;
      const auto at = rows.begin() + static_cast<std::ptrdiff_t>(i / width * columns);
      ADD_FAILURE() << c.name << " at " << absl::StrJoin(at, at + static_cast<std::ptrdiff_t>(columns), " ")
                    << ": result " << i % width << " is " << results[i];
    }
    EXPECT_EQ(bad, 0) << c.name;
  }
  test_support::figure("rows", static_cast<double>(rows_in_all));
}

// Tells whether a field of a primitive is a place in space.
bool is_point(const std::string& field) {
  return field == "center" || field == "a" || field == "b" || field == "point";
}

// Draws lengths, coordinates and other parameters from the ends of what is accepted and from between.
class ExtremeScene {
 public:
  explicit ExtremeScene(std::uint64_t seed) : random_(seed) {}

  Random& random() { return random_; }

  double length() {
    constexpr double kLengths[] = {1e-9, 1e-6, 1e-3, 0.1, 0.5, 1, 1, 2, 10, 1e3, 1e6, 1e9};
    return of(kLengths);
  }
  double coordinate() {
    constexpr double kCoordinates[] = {0, 0, 0, 1e-30, 1e-9, -1e-3, 0.3, -1, 1, 50, -1e4, 1e9, -1e9};
    return of(kCoordinates);
  }
  std::string point() { return absl::StrCat("[", coordinate(), ", ", coordinate(), ", ", coordinate(), "]"); }

  std::string lengths() { return absl::StrCat("[", length(), ", ", length(), ", ", length(), "]"); }

  // Returns a value for a field of a primitive.
  std::string number(const std::string& field) {
    if (is_point(field)) return point();
    if (field == "axis" || field == "normal") return "[1, 1e-9, -1e9]";
    if (field == "half_size" || field == "semi_axes") return lengths();
    if (field == "rounding") return random_.chance(0.5) ? "0" : "1e-9";
    if (field == "law") return R"("SIGNED")";
    if (field != "range" && !absl::StrContains(field, "radius")) {
      ADD_FAILURE() << "there are no extreme numbers for the field " << field;
    }
    return absl::StrCat(length());
  }

  // Returns a primitive with a value for every field that its message has.
  std::string leaf(const std::string& name, bool is_signed, const std::string& kind) {
    const auto* const body = v1::Node::descriptor()->FindFieldByName(kind)->message_type();
    std::vector<std::string> fields;
    for (int i = 0; i < body->field_count(); ++i) {
      const std::string& field = body->field(i)->name();
      if (field == (is_signed ? "range" : "law")) continue;
      fields.push_back(absl::StrCat("\"", field, "\": ", number(field)));
    }
    return absl::StrCat(R"({"name": ")", name, R"(", ")", kind, R"(": {)", absl::StrJoin(fields, ", "), "}}");
  }

  // Returns a transform of `name`, called name + "t". Its condition is within the accepted limit.
  std::string transform(const std::string& name) {
    constexpr double kScales[] = {1e-9, 1e-5, 1, 1, 3, 1e5, 1e9};
    const double scale = of(kScales);
    constexpr double kRatios[] = {1, 2, 1e3, 9e5};
    return absl::StrCat(R"({"name": ")", name, R"(t", "transform": {"child": ")", name, R"(", "scale": [)", scale, ", ",
                        std::min(scale * of(kRatios), 1e9), ", ", scale, R"(], "rotation": [1, 2, -3, 40]}})");
  }

  // Moves the operator's parameters to the ends of their ranges, but keeps its opcodes.
  void make_extreme(Operator& op) {
    const bool has_weights = op.kind() != Kind::kSuperelliptic;
    for (operators::Term& t : terms_of(op)) {
      t = {length(), std::max(of(kExponents), 1.0001), has_weights ? of(kWeights) : 1};
    }
    std::visit([&](auto& kind) { make_extreme(kind); }, op.parameters);
  }

 private:
  void make_extreme(operators::Ricci& op) { op.exponent = of(kExponents); }
  void make_extreme(operators::Superelliptic& op) {
    op.exponent = of(kExponents);
    op.elimination.omega = of(kOmegas);
  }
  void make_extreme(operators::Bt2& op) {
    op.elimination.omega = of(kOmegas);
    constexpr double kTightness[] = {1e-9, 0.1, 1, 100, 1e14};
    op.conic = (1 - of(kTightness)) * op.term(0).range * op.term(1).range;
  }
  void make_extreme(operators::Btk& op) { op.elimination.omega = of(kOmegas); }
  void make_extreme(operators::Pasko& op) {
    op.a0 = random_.chance(0.5) ? length() : -length();
    op.a1 = length();
    op.a2 = length();
  }
  void make_extreme(operators::Functional& op) {
    const double x = random_.chance(0.3) ? 0 : length(), width = length();
    op.h = operators::SampledCurve({x, x + width, x + 3 * width}, {length(), -length(), 0});
  }
  template <class Kind>
  void make_extreme(Kind&) {}

  static constexpr double kExponents[] = {1, 1.5, 2, 8, 64};
  static constexpr double kWeights[] = {1e-3, 0.5, 1, 1, 1e3};
  static constexpr double kOmegas[] = {0.001, 0.01, 1};

 public:
  template <std::size_t N>
  double of(const double (&values)[N]) {
    return values[random_.integer(0, static_cast<int>(N) - 1)];
  }

 private:
  Random random_;
};

// The kinds of a scene's three leaves, and whether a transform stands above each of them.
struct Shapes {
  const char* leaves[3];
  bool has_maps;
};

std::string gradient_node(const Operator& op, const std::string& children, ExtremeScene& extreme) {
  constexpr const char* kOpenings[] = {"CAMEL", "ORGANIC", "CONTACT"};
  const auto& gradient = *op.as<operators::Gradient>();
  const bool is_bulge = gradient.silhouette.kind == operators::Silhouette::Kind::kBulge;
  const char* form = op.form == Form::kUnion ? "UNION" : op.form == Form::kIntersection ? "INTERSECTION" : "DIFFERENCE";
  return absl::StrCat(R"("gradient": {"children": [)", children, R"(], "opening": {"preset": ")",
                      kOpenings[extreme.random().integer(0, 2)], R"("}, "silhouette": )",
                      is_bulge ? absl::StrCat(R"({"kind": "BULGE", "k": )", extreme.random().number(0, 1), "}") : "{}",
                      R"(, "form": ")", form, R"(", "volume": )", gradient.volume, "}}");
}

// Returns a scene of the operator over three leaves. An operator of two operands is folded with itself, so that its
// result meets another operand. Differences of signed fields are converted to positive ones.
std::string scene_text(Case c, const Shapes& shapes, ExtremeScene& extreme) {
  const bool is_signed = c.op.law() == Law::kSigned;
  extreme.make_extreme(c.op);
  std::vector<std::string> nodes, names;
  for (int i = 0; i < 3; ++i) {
    std::string name = absl::StrCat("p", i);
    nodes.push_back(extreme.leaf(name, is_signed, shapes.leaves[i]));
    if (shapes.has_maps) {
      nodes.push_back(extreme.transform(name));
      name += "t";
    }
    names.push_back(name);
  }
  const auto node = [&](const std::vector<std::string>& children, const std::string& name) {
    if (c.op.kind() != Kind::kGradient) return operator_node(c.op, children, name);
    return absl::StrCat(R"({"name": ")", name, R"(", )",
                        gradient_node(c.op, absl::StrCat("\"", absl::StrJoin(children, "\", \""), "\""), extreme));
  };
  if (c.operands == 3) {
    nodes.push_back(node(names, "all"));
  } else {
    nodes.push_back(node({names[0], names[1]}, "two"));
    nodes.push_back(node({"two", names[2]}, "all"));
  }
  // Some scenes yield a signed field, others the positive one made of it.
  if (is_signed && c.op.form == Form::kDifference) {
    nodes.push_back(absl::StrCat(R"({"soften": {"child": "all", "range": )", extreme.length(), "}}"));
  }
  return absl::StrCat("[", absl::StrJoin(nodes, ",\n"), "]");
}

// Returns points at float32's ends and points around the leaves.
std::vector<float> extreme_points(const v1::Scene& scene, int count, Random& random) {
  constexpr float kEnds[] = {0, -0.0f, 1e-45f, 1.2e-38f, -1e-30f, 1e-20f, -1e-9f, 1e-3f,  0.3f, -1,
                             1, 50,    -1e4f,  1e9f,     -1e9f,   1e10f,  1e15f,  -3e38f, kMost};
  std::vector<blobtree::dvec3> centres{{0, 0, 0}};
  const auto* const kind = v1::Node::descriptor()->FindOneofByName("kind");
  for (const v1::Node& node : scene.nodes()) {
    const auto& reflection = *node.GetReflection();
    const google::protobuf::Message& body = reflection.GetMessage(node, reflection.GetOneofFieldDescriptor(node, kind));
    for (int i = 0; i < body.GetDescriptor()->field_count(); ++i) {
      const auto* const field = body.GetDescriptor()->field(i);
      if (!field->is_repeated() || !is_point(field->name()) || body.GetReflection()->FieldSize(body, field) != 3)
        continue;
      const auto x = [&](int axis) { return body.GetReflection()->GetRepeatedDouble(body, field, axis); };
      centres.push_back({x(0), x(1), x(2)});
    }
  }
  std::vector<float> points;
  for (int i = 0; i < count; ++i) {
    if (i % 4 == 0) {
      for (int k = 0; k < 3; ++k) points.push_back(kEnds[random.integer(0, std::size(kEnds) - 1)]);
      continue;
    }
    const blobtree::dvec3& centre = centres[random.integer(0, static_cast<int>(centres.size()) - 1)];
    const double reach = std::pow(10, random.number(-12, 11));
    const blobtree::dvec3 p = i % 29 == 0 ? centre : centre + random.point(-1, 1) * reach;
    for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
  }
  return points;
}

bool is_same_blend(const operators::Gradient* a, const operators::Gradient* b) {
  return !a || !b || (a->silhouette.kind == b->silhouette.kind && a->volume == b->volume);
}

TEST(Finite, ScenesAreAtTheEndsOfTheirParametersAndPoints) {
  constexpr int kScenes = 16, kPoints = 1700;
  static engine::FieldEvaluator evaluator(device(), kernels(), workers());
  std::size_t pairs = 0, sets = 0, refused = 0;
  std::vector<Case> all;
  for (Case& c : all_cases()) {
    // One case of each kind, form and whether it follows an angle is enough.
    const auto is_alike = [&](const Case& other) {
      return other.op.kind() == c.op.kind() && other.op.form == c.op.form &&
             other.op.has_angular_ranges() == c.op.has_angular_ranges() &&
             is_same_blend(other.op.as<operators::Gradient>(), c.op.as<operators::Gradient>());
    };
    // An intersection of signed fields differs from the union only in signs.
    const bool is_turned = c.op.form == Form::kIntersection && c.op.law() == Law::kSigned;
    if (!is_turned && std::none_of(all.begin(), all.end(), is_alike)) all.push_back(std::move(c));
  }
  const auto& primitives = test_support::primitive_nodes();
  ASSERT_GE(all.size(), primitives.size()) << "not every kind of primitive has its turn";
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Case& c = all[n];
    const auto kind = [&](std::size_t i) { return primitives[(n + i) % primitives.size()].kind; };
    const Shapes shapes{{kind(0), kind(1), kind(3)}, n % 3 != 0};
    ExtremeScene extreme(n);
    std::size_t bad = 0;
    ++sets;
    for (int s = 0; s < kScenes; ++s) {
      // Scenes that are refused are drawn again.
      for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string text = scene_text(c, shapes, extreme);
        const v1::Scene message = test_support::scene_of_nodes(text);
        const auto scene = blobtree::read_scene(message, {});
        if (!scene.ok() || !blobtree::compile(*scene).ok()) {
          ++refused;
          continue;
        }
        const engine::SceneLease lease = resident(message);
        const std::vector<float> points = extreme_points(message, kPoints, extreme.random());
        std::vector<float> out(kPoints * 4);
        const absl::Status status = evaluator.evaluate(*lease, points, engine::ResultLayout::kValueAndGradient, out);
        ASSERT_TRUE(status.ok()) << status << text;
        pairs += kPoints;
        for (std::size_t i = 0; i < out.size(); i += 4) {
          if (std::isfinite(out[i]) && std::isfinite(out[i + 1]) && std::isfinite(out[i + 2]) &&
              std::isfinite(out[i + 3])) {
            continue;
          }
          if (++bad > 1) continue;
          const float* p = &points[i / 4 * 3];
          ADD_FAILURE() << c.name << " at " << p[0] << " " << p[1] << " " << p[2] << ": " << out[i] << " with gradient "
                        << out[i + 1] << " " << out[i + 2] << " " << out[i + 3] << "\n"
                        << text;
        }
        break;
      }
    }
    EXPECT_EQ(bad, 0u) << c.name;
  }
  test_support::figure("opcode sets", static_cast<double>(sets));
  test_support::figure("scenes refused and drawn again", static_cast<double>(refused));
  test_support::figure("scenes and points", static_cast<double>(pairs));
  EXPECT_GE(pairs, 1'000'000u);
}

}  // namespace
}  // namespace isofield::gpu_test
