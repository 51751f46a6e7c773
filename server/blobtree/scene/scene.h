// A scene that has passed validation: the graph of a Scene message with references resolved, defaults filled in and
// angles in radians. Children come before parents are evaluated, not before them in `nodes`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "blobtree/geometry/affine.h"
#include "blobtree/primitives/leaf.h"
#include "operators/operator.h"

namespace isofield::blobtree {

enum class NodeKind { kPrimitive, kOperator, kTransform, kSoften, kHarden };

struct Node {
  NodeKind kind = NodeKind::kPrimitive;
  operators::Law law = operators::Law::kPositive;  // of what it yields
  std::string path;                                // for errors: nodes[3] 'arm/upper'
  std::vector<std::uint32_t> children;             // places in Scene::nodes

  Primitive primitive;  // kPrimitive
  double range = 0;     // kSoften
  Affine frame;         // kTransform

  std::shared_ptr<const operators::Operator> op;  // kOperator
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
  std::uint64_t max_profiles = 2'000;        // different openings, silhouettes and curves: a table of 8 to 64 KiB each
};

// Different volumes that one scene's operators may use: each takes a binding of the kernels.
inline constexpr std::size_t kMaxVolumes = 4;

using base::kMaxCoordinate;
using base::kMinLength;

}  // namespace isofield::blobtree
