#include "engine/likely_edits.h"

#include <absl/strings/str_cat.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <string>

#include "blobtree/tape/extent.h"

namespace isofield::engine {
namespace {

// The size of an added primitive, as a part of the longest edge of the scene's support.
constexpr double kSize = 0.1;

// A copy of a scene to which nodes are appended.
class Draft {
 public:
  Draft(const v1::Scene& scene, const blobtree::Tape& tape)
      : scene_(scene), is_signed_(tape.law == operators::Law::kSigned) {
    if (scene_.root().empty()) scene_.set_root(reference(scene_.nodes_size() - 1));
    if (tape.support.empty() || !blobtree::is_bounded(tape)) return;
    corner_ = tape.support.max;
    size_ = kSize * blobtree::longest_edge(tape.support);
  }

  v1::Node& add() { return *scene_.add_nodes(); }
  std::string last() const { return reference(scene_.nodes_size() - 1); }
  const std::string& root() const { return scene_.root(); }
  void set_root(const std::string& root) { scene_.set_root(root); }

  void add_box() {
    v1::Box& box = *add().mutable_box();
    set(corner_, *box.mutable_center());
    set({size_, size_, size_}, *box.mutable_half_size());
    finish(box);
  }
  void add_cylinder() {
    v1::Cylinder& cylinder = *add().mutable_cylinder();
    set(corner_, *cylinder.mutable_a());
    set({corner_.x - size_, corner_.y, corner_.z}, *cylinder.mutable_b());
    cylinder.set_radius(size_ / 2);
    finish(cylinder);
  }
  // Adds a copy of a primitive that the scene has already, which needs no further kernels, or a box if it has none.
  void add_known() {
    const auto& nodes = scene_.nodes();
    const auto known = std::find_if(nodes.begin(), nodes.end(), [&](const v1::Node& n) { return is_alike(n); });
    if (known == nodes.end()) return add_box();
    v1::Node copy = *known;
    copy.clear_name();
    add() = std::move(copy);
  }

  // Joins the last node with the scene. If the root takes any number of operands, the node becomes one of them;
  // otherwise a new root joins both.
  v1::Scene join_last() && {
    if (google::protobuf::RepeatedPtrField<std::string>* const children = children_of_root()) {
      children->Add(last());
      return std::move(scene_);
    }
    return is_signed_ ? std::move(*this).over_both(&v1::Node::mutable_min)
                      : std::move(*this).over_both(&v1::Node::mutable_gradient);
  }

  template <class Blend>
  v1::Scene over_both(Blend* (v1::Node::*blend)()) && {
    const std::string old = root(), other = last();
    Blend& joined = *(add().*blend)();
    joined.add_children(old);
    joined.add_children(other);
    set_root(last());
    return std::move(scene_);
  }

  bool is_signed() const { return is_signed_; }

 private:
  static std::string reference(int node) { return absl::StrCat("#", node); }
  // Returns true for a primitive whose field follows the scene's law.
  bool is_alike(const v1::Node& node) const {
    const google::protobuf::FieldDescriptor* const kind = node.GetDescriptor()->FindFieldByNumber(node.kind_case());
    const auto* const law = kind ? kind->message_type()->FindFieldByName("law") : nullptr;
    if (!law) return false;
    const google::protobuf::Message& primitive = node.GetReflection()->GetMessage(node, kind);
    return (primitive.GetReflection()->GetEnumValue(primitive, law) == v1::SIGNED) == is_signed_;
  }
  static void set(const blobtree::dvec3& v, google::protobuf::RepeatedField<double>& out) {
    for (const double x : {v.x, v.y, v.z}) out.Add(x);
  }
  template <class Primitive>
  void finish(Primitive& primitive) {
    if (is_signed_) {
      primitive.set_law(v1::SIGNED);
    } else {
      primitive.set_range(size_);
    }
  }

  // Returns the children of the root if it is an operator that takes any number of them; else null.
  google::protobuf::RepeatedPtrField<std::string>* children_of_root() {
    for (int i = 0; i < scene_.nodes_size(); ++i) {
      v1::Node& node = *scene_.mutable_nodes(i);
      if (root() != node.name() && root() != reference(i)) continue;
      switch (node.kind_case()) {
        case v1::Node::kSum:
          return node.mutable_sum()->mutable_children();
        case v1::Node::kMax:
          return node.mutable_max()->mutable_children();
        case v1::Node::kMin:
          return node.mutable_min()->mutable_children();
        case v1::Node::kRicci:
          return node.mutable_ricci()->mutable_children();
        case v1::Node::kGradient:
          return node.mutable_gradient()->mutable_children();
        default:
          return nullptr;
      }
    }
    return nullptr;
  }

  v1::Scene scene_;
  const bool is_signed_;
  blobtree::dvec3 corner_{0, 0, 0};
  double size_ = 1;
};

}  // namespace

std::vector<v1::Scene> likely_edits(const v1::Scene& scene, const blobtree::Tape& tape) {
  std::vector<v1::Scene> likely;
  const Draft draft(scene, tape);
  Draft boxed = draft, rounded = draft, cut = draft, blended = draft;
  boxed.add_box();
  likely.push_back(std::move(boxed).join_last());
  rounded.add_cylinder();
  likely.push_back(std::move(rounded).join_last());
  cut.add_known();
  likely.push_back(std::move(cut).over_both(&v1::Node::mutable_difference));
  if (!draft.is_signed()) {
    blended.add_known();
    likely.push_back(std::move(blended).over_both(&v1::Node::mutable_gradient));
  }
  return likely;
}

}  // namespace isofield::engine
