#include "blobtree/parameter_layout.h"

#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "blobtree/leaf_placer.h"

namespace isofield::blobtree {
namespace {

float f(double x) {
  return static_cast<float>(x);
}

void write_leaf(const Leaf& leaf, Float4* out) {
  const ShapeSize& s = leaf.size;
  const float slope = f((1 - kR0) / leaf.range);  // dr/dd
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
    return find(silhouettes_, s, [&] { return operators::silhouette_table(s); });
  }
  std::uint32_t opening(const operators::Opening& o) {
    return find(openings_, o, [&] { return operators::opening_table(o); });
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
};

}  // namespace

ParameterBuffers lay_out(const Tape& tape) {
  ParameterBuffers buffers;
  buffers.leaves.resize(std::max<std::size_t>(tape.leaf_records, 1));
  for (const Leaf& leaf : tape.leaves) write_leaf(leaf, &buffers.leaves[leaf.record]);
  buffers.operations.resize(std::max<std::size_t>(tape.operations.size(), 1));
  Tables tables(buffers.tables);
  for (const Operation& o : tape.operations) {
    Float4& record = buffers.operations[o.record];
    if (o.op == Operator::kRicci) {
      record = {f(o.exponent), f(1 / o.exponent), 0, 0};
    } else if (o.op == Operator::kGradient || o.op == Operator::kGradientTable) {
      const std::uint32_t silhouette = o.op == Operator::kGradient ? 0 : tables.silhouette(o.silhouette);
      record = {std::bit_cast<float>(tables.opening(o.opening)), std::bit_cast<float>(silhouette),
                f(std::tan(o.opening.theta_min())), f(o.length)};
    }
  }
  if (buffers.tables.empty()) buffers.tables.resize(1);
  return buffers;
}

}  // namespace isofield::blobtree
