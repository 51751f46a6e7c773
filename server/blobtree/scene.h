// A scene that has passed validation: the graph of a Scene message with references resolved, defaults filled in and
// angles in radians. Children come before parents are evaluated, not before them in `nodes`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blobtree/affine.h"
#include "blobtree/distance.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::blobtree {

enum class NodeKind { kPrimitive, kSum, kMax, kMin, kDifference, kRicci, kGradient, kTransform };

struct Node {
  NodeKind kind = NodeKind::kPrimitive;
  std::string path;                     // for errors: nodes[3] 'arm/upper'
  std::vector<std::uint32_t> children;  // places in Scene::nodes

  // kPrimitive: its frame maps the shape's own frame to the node's.
  Shape shape = Shape::kSphere;
  ShapeSize size{};
  double range = 0;
  // kPrimitive, kTransform
  Affine frame;

  double exponent = 1;               // kRicci
  operators::Opening opening{};      // kGradient
  operators::Silhouette silhouette;  // kGradient
};

struct Scene {
  std::vector<Node> nodes;
  std::uint32_t root = 0;
  // Nodes that the root reaches, each after its children.
  std::vector<std::uint32_t> order;
};

// What a scene may be at most; beyond is RESOURCE_EXHAUSTED's business at the edge, INVALID_ARGUMENT here.
struct SceneLimits {
  std::uint64_t max_nodes = 1'000'000;
  std::uint64_t max_primitives = 1'000'000;  // after instancing
  std::uint64_t max_profiles = 2'000;        // different openings and silhouettes: a table of 4 KiB each
};

// Lengths and coordinates beyond these would leave the range in which float32 squares are finite.
inline constexpr double kMaxCoordinate = 1e9;
inline constexpr double kMinLength = 1e-9;
inline constexpr double kMaxCondition = 1e6;  // of a transform's linear part

}  // namespace isofield::blobtree
