#include "blobtree/tape/parameter_layout.h"

#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "blobtree/primitives/leaf_placer.h"

namespace isofield::blobtree {
namespace {

float f(double x) {
  return static_cast<float>(x);
}

void write_leaf(const Leaf& leaf, Float4* out) {
  const ShapeSize& s = leaf.size;
  // dr/dd of the falloff; of a signed field minus what the distance is multiplied by.
  const float slope = leaf.law == operators::Law::kSigned ? f(-leaf.per_distance) : f((1 - kR0) / leaf.range);
  const Float4 anchor{f(leaf.anchor.x), f(leaf.anchor.y), f(leaf.anchor.z), slope};
  const auto rows = [&](double p0, double p1, double p2) {
    const auto& m = leaf.to_local.linear;
    out[0] = anchor;
    out[1] = {f(m[0].x), f(m[0].y), f(m[0].z), f(p0)};
    out[2] = {f(m[1].x), f(m[1].y), f(m[1].z), f(p1)};
    out[3] = {f(m[2].x), f(m[2].y), f(m[2].z), f(p2)};
  };
  // A round cone's slope of the radius and tangent of its tilt; an end that contains the other is a sphere.
  struct Cone {
    double centre, length, radius, slope, tan;
  };
  const auto cone = [&]() -> Cone {
    const double drop = s[1] - s[2];
    if (std::abs(drop) >= s[0]) return {drop >= 0 ? 0 : s[0], 0, std::max(s[1], s[2]), 0, 0};
    const double sin = drop / s[0];
    return {0, s[0], s[1], -sin, sin / std::sqrt(1 - sin * sin)};
  };
  switch (leaf.operand) {
    case Operand::kSphere:
      out[0] = anchor;
      out[1] = {f(s[0]), 0, 0, 0};
      break;
    case Operand::kSegment: {
      const Cone c = cone();
      const dvec3& axis = leaf.to_local.linear[2];
      const dvec3 a = leaf.anchor + axis * c.centre;
      out[0] = {f(a.x), f(a.y), f(a.z), slope};
      out[1] = {f(axis.x), f(axis.y), f(axis.z), f(c.length)};
      out[2] = {f(c.radius), f(c.slope), f(c.tan), 0};
      break;
    }
    case Operand::kBox:
      rows(s[0] - s[3], s[1] - s[3], s[2] - s[3]);
      out[4] = {f(s[3]), 0, 0, 0};
      break;
    case Operand::kCylinder:
    case Operand::kTorus:
      rows(s[0], s[1], 0);
      break;
    case Operand::kEllipsoid: {
      if (leaf.shape == Shape::kSphere) {
        rows(s[0], 0, 0);
        break;
      }
      const double least = std::min({s[0], s[1], s[2]});
      rows(least, 0, 0);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out[r + 1][c] *= f(least / s[r]);
      }
      break;
    }
    case Operand::kAffineSegment: {
      const Cone c = cone();
      rows(c.length, c.radius, c.slope);
      // The centre of an end that contains the other lies at the anchor's place along the axis.
      out[0][3] = slope;
      if (c.centre != 0) {
        const auto world = leaf.to_local.inverse();
        const dvec3 a = leaf.anchor + world->vector({0, 0, c.centre});
        out[0] = {f(a.x), f(a.y), f(a.z), slope};
      }
      break;
    }
    default:
      break;
  }
}

// Offsets of tables that several operations share.
class Tables {
 public:
  explicit Tables(std::vector<Float4>& out) : out_(out) {}

  std::uint32_t silhouette(const operators::Silhouette& s) {
    // A silhouette with two different halves is marked by bit 30.
    return find(silhouettes_, s, [&] { return operators::silhouette_table(s); }) | (s.is_symmetric() ? 0 : 1u << 30);
  }
  std::uint32_t opening(const operators::Opening& o) {
    return find(openings_, o, [&] { return operators::opening_table(o); });
  }
  std::uint32_t curve(const operators::SampledCurve& c) {
    return find(curves_, c, [&] { return operators::curve_table(c); });
  }

 private:
  template <class Key, class Make>
  std::uint32_t find(std::map<Key, std::uint32_t>& known, const Key& key, Make make) {
    const auto [it, is_new] = known.try_emplace(key);
    if (is_new) it->second = append(make());
    return it->second;
  }
  std::uint32_t append(const operators::ProfileTable& table) {
    const auto offset = static_cast<std::uint32_t>(out_.size());
    out_.insert(out_.end(), table.begin(), table.end());
    return offset;
  }

  std::vector<Float4>& out_;
  std::map<operators::Silhouette, std::uint32_t> silhouettes_;
  std::map<operators::Opening, std::uint32_t> openings_;
  std::map<operators::SampledCurve, std::uint32_t> curves_;
};

// What a `sampled` or `volume` operator finds its samples by: the slot of the volume's binding and its size.
std::uint32_t pack_volume(std::uint32_t slot, int size) {
  return slot | static_cast<std::uint32_t>(size) << 8;
}

class Layout {
 public:
  explicit Layout(const Tape& tape) : tape_(tape), tables_(buffers_.tables) {}

  ParameterBuffers run() {
    buffers_.operations.resize(std::max<std::size_t>(tape_.record_owners.size(), 1));
    for (const Operation& o : tape_.operations) write_operation(o, &buffers_.operations[o.record]);
    if (buffers_.tables.empty()) buffers_.tables.resize(1);
    return std::move(buffers_);
  }

 private:
  void write_operation(const Operation& o, Float4* out) {
    if (o.frame) {
      const Affine::LowerTriangle& l = *o.frame;
      out[-2] = {f(l[0]), f(l[1]), f(l[2]), f(l[3])};
      out[-1] = {f(l[4]), f(l[5]), 0, 0};
    }
    switch (o.op) {
      case Operator::kLinear:
        out[0] = {f(o.factor), f(o.offset), 0, 0};
        break;
      case Operator::kSoften:
        out[0] = {f((1 - kR0) / o.range), 0, 0, 0};
        break;
      case Operator::kRicci:
        out[0] = {f(o.what->exponent), f(1 / o.what->exponent), 0, 0};
        break;
      case Operator::kGradient:
        out[0] = steered(o, 0);
        break;
      case Operator::kGradientTable:
        out[0] = steered(o, tables_.silhouette(o.what->silhouette));
        break;
      case Operator::kGradientVolume:
        out[0] = steered(o, pack_volume(o.volume_slot, operators::volume_key(*o.what).size));
        // A sampled operator is homogeneous about the origin, a volume of the gradient blend about (t/2, t/2).
        if (o.what->kind == operators::Kind::kSampled) out[0][3] = -out[0][3];
        break;
      case Operator::kBarthe:
      case Operator::kBernhardt:
        out[0] = {f(std::tan(o.what->theta1)), f(std::tan(o.what->theta2)), f(o.what->weight), 0};
        break;
      case Operator::kPasko:
        out[0] = {o.what->kind == operators::Kind::kPasko ? f(o.what->a0) : 0, f(1 / (o.what->a1 * o.what->a1)),
                  f(1 / (o.what->a2 * o.what->a2)), 0};
        break;
      case Operator::kFunctional: {
        const operators::SampledCurve& h = o.what->curve;
        const auto pieces = static_cast<std::uint32_t>(h.x().size() - 1);
        out[0] = {std::bit_cast<float>(tables_.curve(h)), std::bit_cast<float>(pieces), f(h.x().back()),
                  f(h.y().back())};
        break;
      }
      case Operator::kBt2:
        out[0] = {f(o.what->term(0).range), f(o.what->term(1).range), f(o.what->tightness()), omega(o)};
        for (std::uint32_t i = 0; i < 2; ++i) {
          const double weight = o.what->term(i).weight;
          out[1 + i] = {f(1 / weight), 0, f(weight), 0};
        }
        break;
      case Operator::kSuperelliptic:
      case Operator::kBtk:
        out[0] = {f(o.what->exponent), omega(o), 0, 0};
        if (o.op == Operator::kSuperelliptic) {
          // The base whose power is 1e12, and what float32 leaves of it as a part of it: the exponent multiplies that.
          const double deepest = std::pow(1e12, 1 / o.what->exponent);
          out[0][2] = f(deepest);
          out[0][3] = f(deepest / out[0][2] - 1);
        }
        for (std::uint32_t i = 0; i < o.operands; ++i) {
          const operators::Term& t = o.what->term(i);
          // The third number is the power; an operator of weights 1 needs no other.
          out[1 + i] = {f(1 / t.weight), 0, f(t.power), f(t.range)};
        }
        break;
      default:
        break;
    }
  }

  static float omega(const Operation& o) { return o.what->by_angle ? f(o.what->omega) : -1.0f; }

  Float4 steered(const Operation& o, std::uint32_t silhouette) {
    return {std::bit_cast<float>(tables_.opening(o.what->opening)), std::bit_cast<float>(silhouette),
            f(std::tan(o.what->opening.theta_min())), f(o.length)};
  }

  const Tape& tape_;
  ParameterBuffers buffers_;
  Tables tables_;
};

}  // namespace

ParameterBuffers lay_out(const Tape& tape) {
  ParameterBuffers buffers = lay_out_operations(tape);
  buffers.leaves.resize(std::max<std::size_t>(tape.leaf_records, 1));
  for (const Leaf& leaf : tape.leaves) write_leaf(leaf, &buffers.leaves[leaf.record]);
  return buffers;
}

ParameterBuffers lay_out_operations(const Tape& tape) {
  return Layout(tape).run();
}

}  // namespace isofield::blobtree
