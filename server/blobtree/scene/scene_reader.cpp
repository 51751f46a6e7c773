#include "blobtree/scene/scene_reader.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/string_view.h>

#include <algorithm>
#include <optional>
#include <set>

#include "base/nearest_name.h"
#include "base/quoted.h"
#include "blobtree/scene/node_reader.h"
#include "blobtree/scene/profile_count.h"

namespace isofield::blobtree {
namespace {

// A node's name and the unit have at most this many bytes, because answers repeat them.
constexpr std::size_t kMaxNameBytes = 256;

// References holds the names of nodes and resolves references, which are "name" or "#i".
class References {
 public:
  absl::Status add(const v1::Node& node, std::uint32_t index, const std::string& path) {
    const std::string& name = node.name();
    if (name.empty()) return absl::OkStatus();
    if (name[0] == '#' || name.find('.') != std::string::npos || name.size() > kMaxNameBytes) {
      return absl::InvalidArgumentError(absl::StrCat(path, ".name = ", base::quoted(name),
                                                     ": expected a name of at most ", kMaxNameBytes,
                                                     " bytes that does not start with '#' and holds no '.'"));
    }
    const auto [place, added] = names_.emplace(name, index);
    if (!added) {
      return absl::InvalidArgumentError(
          absl::StrCat(path, ".name = ", base::quoted(name), ": already the name of nodes[", place->second, "]"));
    }
    return absl::OkStatus();
  }

  // Returns the error for a reference to no node. `what` says where it stands: at a child or at the root.
  absl::Status refuse(absl::string_view what, const std::string& reference, std::size_t node_count) const {
    std::vector<std::string> names;
    for (const auto& [name, index] : names_) names.push_back(name);
    std::sort(names.begin(), names.end());
    return absl::InvalidArgumentError(absl::StrCat(what, " ", base::quoted(reference),
                                                   " is no node: expected a node's name, or #0 to #", node_count - 1,
                                                   base::did_you_mean(reference, names)));
  }

  // Returns nothing if there is no such node.
  std::optional<std::uint32_t> find(absl::string_view reference, std::size_t node_count) const {
    if (!reference.empty() && reference[0] == '#') {
      const absl::string_view digits = reference.substr(1);
      std::uint32_t index = 0;
      // SimpleAtoi() admits spaces and signs, which a reference may not have.
      if (!std::all_of(digits.begin(), digits.end(), absl::ascii_isdigit) || !absl::SimpleAtoi(digits, &index) ||
          index >= node_count) {
        return std::nullopt;
      }
      return index;
    }
    const auto it = names_.find(reference);
    if (it == names_.end()) return std::nullopt;
    return it->second;
  }

 private:
  absl::flat_hash_map<std::string, std::uint32_t> names_;
};

// A Mark tells whether a node has not been visited, is on the way from `start`, or is done.
enum class Mark : char { kNew, kOpen, kDone };

// Appends `start` and all nodes below it to `order`, children first, except those that it already has. It refuses
// cycles.
absl::Status sort_from(const Scene& scene, std::uint32_t start, std::vector<Mark>& marks,
                       std::vector<std::uint32_t>& order) {
  struct Visit {
    std::uint32_t node;
    std::size_t next_child;
  };
  if (marks[start] == Mark::kDone) return absl::OkStatus();
  std::vector<Visit> stack{{start, 0}};
  marks[start] = Mark::kOpen;
  while (!stack.empty()) {
    Visit& top = stack.back();
    const Node& node = scene.nodes[top.node];
    if (top.next_child == node.children.size()) {
      marks[top.node] = Mark::kDone;
      order.push_back(top.node);
      stack.pop_back();
      continue;
    }
    const std::uint32_t child = node.children[top.next_child++];
    if (marks[child] == Mark::kOpen) {
      return absl::InvalidArgumentError(absl::StrCat(node.path, ".children: ", scene.nodes[child].path,
                                                     " closes a cycle; expected a graph without cycles"));
    }
    if (marks[child] == Mark::kNew) {
      marks[child] = Mark::kOpen;
      stack.push_back({child, 0});
    }
  }
  return absl::OkStatus();
}

absl::Status check_operand_count(const Node& node) {
  const auto count = node.children.size();
  const operators::OperandCount wanted = node.op->operand_count();
  if (count >= wanted.least && count <= wanted.most) return absl::OkStatus();
  std::string expected = absl::StrCat("at least ", wanted.least, wanted.least == 1 ? " child" : " children");
  if (wanted.most == wanted.least) {
    expected = absl::StrCat("exactly ", wanted.least, " children");
  } else if (wanted.most <= operators::kMaxOperands) {
    expected = absl::StrCat(wanted.least, " to ", wanted.most, " children");
  }
  if (count == 0) {
    return absl::InvalidArgumentError(absl::StrCat(node.path, ".children is missing: expected ", expected));
  }
  return absl::InvalidArgumentError(
      absl::StrCat(node.path, ".children = [", count, count == 1 ? " child" : " children", "]: expected ", expected));
}

// Checks, children before parents, that each operator has as many children as it can take, all of one law. It also sets
// the law of nodes that take either law.
absl::Status check_operands(Scene& scene, const std::vector<std::uint32_t>& order) {
  const auto name = [](operators::Law law) { return law == operators::Law::kSigned ? "SIGNED" : "POSITIVE"; };
  const auto other = [](operators::Law law) {
    return law == operators::Law::kSigned ? "; soften makes a signed field positive"
                                          : "; harden makes a positive field signed";
  };
  for (const std::uint32_t index : order) {
    Node& node = scene.nodes[index];
    operators::Law wanted = node.law;
    switch (node.kind) {
      case NodeKind::kPrimitive:
        continue;
      case NodeKind::kTransform:
        node.law = scene.nodes[node.children[0]].law;
        continue;
      case NodeKind::kSoften:
        wanted = operators::Law::kSigned;
        break;
      case NodeKind::kHarden:
        wanted = operators::Law::kPositive;
        break;
      case NodeKind::kOperator:
        if (absl::Status s = check_operand_count(node); !s.ok()) return s;
        if (node.op->takes_either_law()) node.law = wanted = scene.nodes[node.children[0]].law;
        break;
    }
    for (const std::uint32_t child : node.children) {
      const Node& c = scene.nodes[child];
      if (c.law == wanted) continue;
      return absl::InvalidArgumentError(absl::StrCat(
          node.path, node.kind == NodeKind::kOperator ? ".children: " : ".child: ", c.path, " yields a ", name(c.law),
          " field, expected a ", name(wanted), " one", node.kind == NodeKind::kOperator ? other(c.law) : ""));
    }
  }
  return absl::OkStatus();
}

// Cycles and mismatches that the root does not reach are refused, too: they are errors of the file, although this scene
// would not show them.
absl::Status sort_nodes(Scene& scene) {
  std::vector<Mark> marks(scene.nodes.size(), Mark::kNew);
  if (absl::Status s = sort_from(scene, scene.root, marks, scene.order); !s.ok()) return s;
  std::vector<std::uint32_t> all = scene.order;
  for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
    if (absl::Status s = sort_from(scene, i, marks, all); !s.ok()) return s;
  }
  return check_operands(scene, all);
}

// Checks how many primitives and nodes the root stands for if every use of a shared node counts.
absl::Status check_instances(const Scene& scene, const SceneLimits& limits) {
  struct Count {
    std::uint64_t primitives, nodes;
  };
  std::vector<Count> counts(scene.nodes.size());
  for (const std::uint32_t index : scene.order) {
    const Node& node = scene.nodes[index];
    Count count{node.kind == NodeKind::kPrimitive ? 1u : 0u, 1};
    for (const std::uint32_t child : node.children) {
      count.primitives += counts[child].primitives;
      count.nodes += counts[child].nodes;
    }
    if (count.primitives > limits.max_primitives || count.nodes > 8 * limits.max_primitives) {
      return absl::InvalidArgumentError(
          absl::StrCat(node.path, " stands for ", count.primitives, " primitives and ", count.nodes,
                       " nodes once shared nodes are counted at every use: expected at most ", limits.max_primitives,
                       " and ", 8 * limits.max_primitives));
    }
    counts[index] = count;
  }
  return absl::OkStatus();
}

// Checks the number of tables and volumes: each opening, silhouette and curve takes a table on the device, and each
// volume takes a binding of its own.
absl::Status check_profiles(const Scene& scene, const SceneLimits& limits) {
  ProfileCount profiles;
  std::set<operators::VolumeKey> volumes;
  for (const Node& node : scene.nodes) {
    if (!node.op) continue;
    const operators::Operator& op = *node.op;
    const char* const profile = profiles.add(op);
    if (const operators::VolumeKey key = op.volume_key(); key.size != 0) volumes.insert(key);
    if (profile && profiles.size() > limits.max_profiles) {
      return absl::InvalidArgumentError(
          absl::StrCat(node.path, ".", profile, ": more than ", limits.max_profiles,
                       " different openings, silhouettes and curves in one scene: expected at most so many; nodes may "
                       "share them"));
    }
    if (volumes.size() > kMaxVolumes) {
      return absl::InvalidArgumentError(absl::StrCat(node.path, ".volume: more than ", kMaxVolumes,
                                                     " different volumes in one scene: expected at most so many; "
                                                     "operators of equal silhouette and size share one"));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Scene> read_scene(const v1::Scene& message, const SceneLimits& limits, const OperatorTable& custom) {
  const auto count = static_cast<std::size_t>(message.nodes_size());
  if (count == 0) return absl::InvalidArgumentError("nodes is missing: expected at least 1 node");
  if (count > limits.max_nodes) {
    return absl::InvalidArgumentError(absl::StrCat("nodes: ", count, " nodes, expected at most ", limits.max_nodes));
  }
  if (message.unit().size() > kMaxNameBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("unit = ", base::quoted(message.unit()), ": expected at most ", kMaxNameBytes, " bytes"));
  }
  Scene scene;
  scene.nodes.resize(count);
  References references;
  for (std::size_t i = 0; i < count; ++i) {
    Node& node = scene.nodes[i];
    node.path = node_path(i, message.nodes(i));
    if (absl::Status s = references.add(message.nodes(i), i, node.path); !s.ok()) return s;
    if (absl::Status s = read_node(message.nodes(i), custom, node); !s.ok()) return s;
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::string* reference : child_references(message.nodes(i))) {
      const std::optional<std::uint32_t> child = references.find(*reference, count);
      const bool is_single = scene.nodes[i].kind != NodeKind::kOperator;
      if (!child && is_single && reference->empty()) {
        return absl::InvalidArgumentError(
            absl::StrCat(scene.nodes[i].path, ".child is missing: expected a node's name, or #0 to #", count - 1));
      }
      if (!child) return references.refuse(absl::StrCat(scene.nodes[i].path, ": child"), *reference, count);
      scene.nodes[i].children.push_back(*child);
    }
  }
  const std::optional<std::uint32_t> root =
      references.find(message.root().empty() ? absl::StrCat("#", count - 1) : message.root(), count);
  if (!root) return references.refuse("root =", message.root(), count);
  scene.root = *root;
  if (absl::Status s = sort_nodes(scene); !s.ok()) return s;
  if (absl::Status s = check_instances(scene, limits); !s.ok()) return s;
  if (absl::Status s = check_profiles(scene, limits); !s.ok()) return s;
  return scene;
}

}  // namespace isofield::blobtree
