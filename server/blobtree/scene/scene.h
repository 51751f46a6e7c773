// A Scene is a scene that has passed validation: the graph of a Scene message with references resolved, defaults filled
// in and angles in radians. Children need not stand before their parents in `nodes`; `order` has them in that order.
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

// A Node is a node of the scene. Which of its last members are used depends on its kind.
struct Node {
  NodeKind kind = NodeKind::kPrimitive;
  operators::Law law = operators::Law::kPositive;  // law of the field that the node yields
  std::string path;                                // names the node in errors: nodes[3] 'arm/upper'
  std::vector<std::uint32_t> children;             // indices in Scene::nodes

  Primitive primitive;  // kPrimitive
  double range = 0;     // kSoften
  Affine frame;         // kTransform

  std::shared_ptr<const operators::Operator> op;  // kOperator
};

struct Scene {
  std::vector<Node> nodes;
  std::uint32_t root = 0;
  // This has the indices of the nodes that the root reaches, each after its children.
  std::vector<std::uint32_t> order;
};

// These are the limits of a scene; read_scene() refuses a larger one with INVALID_ARGUMENT. Requests have limits of
// their own, at the edge, with RESOURCE_EXHAUSTED.
struct SceneLimits {
  std::uint64_t max_nodes = 1'000'000;
  std::uint64_t max_primitives = 1'000'000;  // counted at every use of a shared node
  std::uint64_t max_profiles = 2'000;        // different openings, silhouettes and curves, each a table of 8 to 64 KiB
};

// One scene's operators may use this many different volumes, because each takes a binding of the kernels.
inline constexpr std::size_t kMaxVolumes = 4;

using base::kMaxCoordinate;
using base::kMinLength;

}  // namespace isofield::blobtree
