#include "integration/local_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using Numbers = google::protobuf::RepeatedField<double>;

google::protobuf::RepeatedPtrField<std::string>* children_of(v1::Node& node) {
  switch (node.kind_case()) {
    case v1::Node::kSum:
      return node.mutable_sum()->mutable_children();
    case v1::Node::kMax:
      return node.mutable_max()->mutable_children();
    case v1::Node::kRicci:
      return node.mutable_ricci()->mutable_children();
    case v1::Node::kGradient:
      return node.mutable_gradient()->mutable_children();
    default:
      std::abort();
  }
}

std::array<double, 6> support_of(const v1::Node& node) {
  const bool is_segment = node.has_segment();
  if (!is_segment && !node.has_sphere()) std::abort();
  const Numbers& a = is_segment ? node.segment().a() : node.sphere().center();
  const Numbers& b = is_segment ? node.segment().b() : a;
  const double reach = is_segment
                           ? std::max(node.segment().radius_a(), node.segment().radius_b()) + node.segment().range()
                           : node.sphere().radius() + node.sphere().range();
  std::array<double, 6> box{};
  for (int i = 0; i < 3; ++i) {
    const double from = a.empty() ? 0 : a[i], to = b.empty() ? 0 : b[i];
    box[i] = std::min(from, to) - reach;
    box[3 + i] = std::max(from, to) + reach;
  }
  return box;
}

}  // namespace

LocalReference::LocalReference(const v1::Scene& scene, double cell) : scene_(scene), cell_(cell) {
  for (int i = 0; i + 1 < scene.nodes_size(); ++i) supports_.push_back(support_of(scene.nodes(i)));
}

reference::Sample LocalReference::evaluate(const blobtree::dvec3& p) {
  const Cell cell{std::llround(std::floor(p.x / cell_)), std::llround(std::floor(p.y / cell_)),
                  std::llround(std::floor(p.z / cell_))};
  auto [at, added] = parts_.try_emplace(cell);
  if (added) at->second = part(cell);
  return at->second ? at->second->evaluate(p) : reference::Sample{};
}

std::unique_ptr<reference::Evaluator> LocalReference::part(const Cell& cell) const {
  v1::Scene near;
  v1::Node join = scene_.nodes(scene_.nodes_size() - 1);
  auto& children = *children_of(join);
  children.Clear();
  for (std::size_t i = 0; i < supports_.size(); ++i) {
    bool touches = true;
    for (int a = 0; a < 3; ++a) {
      const double low = static_cast<double>(cell[a]) * cell_;
      touches = touches && supports_[i][a] <= low + cell_ && supports_[i][3 + a] >= low;
    }
    if (!touches) continue;
    *children.Add() = test_support::place(near.nodes_size());
    *near.add_nodes() = scene_.nodes(static_cast<int>(i));
  }
  if (children.empty()) return nullptr;
  *near.add_nodes() = join;
  return std::make_unique<reference::Evaluator>(test_support::read_or_die(near));
}

}  // namespace isofield::integration_test
