#include "support/random_scene.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace isofield::test_support {
namespace {

constexpr int kMostTransformsAbove = 2;  // above one primitive; the limit keeps coordinates small
constexpr int kMostInstances = 400;      // primitives below one node

void set_point(google::protobuf::RepeatedField<double>* out, const blobtree::dvec3& p) {
  for (const double x : {p.x, p.y, p.z}) out->Add(x);
}

class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, const RandomSceneOptions& options)
      : random_(seed), random_of_late_kinds_(~seed), options_(options) {}

  v1::Scene make() {
    const int primitives = std::max(1, static_cast<int>(options_.nodes * random_.number(0.5, 0.7)));
    for (int i = 0; i < primitives; ++i) {
      if (options_.all_operators && i + 8 < primitives && random_.chance(0.15)) {
        i += 4;  // nodes that are no primitive of their own
        add_signed_tree();
      } else {
        add_primitive();
      }
      // Blends of blends need depth, so some of the unused nodes are joined now and then.
      while (unused_.size() > 1 && random_.chance(0.35)) add_above();
    }
    while (unused_.size() > 1 && static_cast<int>(parts_.size()) < options_.nodes - 1) add_above();
    if (unused_.size() > 1) add_operator(std::exchange(unused_, {}));
    return shuffled();
  }

 private:
  struct Part {
    v1::Node node;
    std::vector<int> children;
    int instances = 1;   // primitives below; a shared one counts at every use
    int transforms = 0;  // the largest number on any way down to a primitive
    bool is_signed = false;
    bool is_bounded = true;
  };

  int add(Part part) {
    for (const int child : part.children) {
      part.transforms = std::max(part.transforms, parts_[child].transforms + (part.node.has_transform() ? 1 : 0));
    }
    if (!part.children.empty()) {
      part.instances = 0;
      for (const int child : part.children) part.instances += parts_[child].instances;
    }
    parts_.push_back(std::move(part));
    unused_.push_back(static_cast<int>(parts_.size()) - 1);
    return unused_.back();
  }

  double length() { return random_.number(0.1, 0.8); }

  void add_primitive() {
    Part part;
    v1::Node& node = part.node;
    const blobtree::dvec3 centre = random_.point(-1.2, 1.2);
    switch (random_.integer(0, 5)) {
      case 0:
        set_point(node.mutable_sphere()->mutable_center(), centre);
        node.mutable_sphere()->set_radius(length());
        node.mutable_sphere()->set_range(length());
        break;
      case 1: {
        v1::Segment& s = *node.mutable_segment();
        set_point(s.mutable_a(), centre);
        // A segment is a point now and then: both ends lie in one place.
        set_point(s.mutable_b(), random_.chance(0.1) ? centre : centre + random_.point(-1, 1));
        s.set_radius_a(length());
        s.set_radius_b(random_.chance(0.4) ? s.radius_a() : length());
        s.set_range(length());
        if (late_chance(0.2) && !std::equal(s.a().begin(), s.a().end(), s.b().begin())) make_cone(node);
        break;
      }
      case 2: {
        v1::Box& b = *node.mutable_box();
        set_point(b.mutable_center(), centre);
        set_point(b.mutable_half_size(), random_.point(0.1, 0.8));
        const double least = *std::min_element(b.half_size().begin(), b.half_size().end());
        b.set_rounding(random_.chance(0.5) ? 0 : random_.number(0, least));
        b.set_range(length());
        break;
      }
      case 3: {
        v1::Cylinder& c = *node.mutable_cylinder();
        set_point(c.mutable_a(), centre);
        set_point(c.mutable_b(), centre + random_.point(0.1, 0.9));
        c.set_radius(length());
        c.set_range(length());
        break;
      }
      case 4: {
        v1::Torus& t = *node.mutable_torus();
        set_point(t.mutable_center(), centre);
        if (random_.chance(0.8)) set_point(t.mutable_axis(), random_.point(0.1, 1));
        t.set_major_radius(random_.number(0.3, 0.8));
        t.set_minor_radius(random_.number(0.1, 0.4));
        t.set_range(length());
        break;
      }
      default: {
        v1::Ellipsoid& e = *node.mutable_ellipsoid();
        set_point(e.mutable_center(), centre);
        set_point(e.mutable_semi_axes(), random_.point(0.2, 0.8));
        e.set_range(length());
      }
    }
    add(std::move(part));
  }

  bool late_chance(double probability) { return random_of_late_kinds_.chance(probability); }

  // Makes a segment a cone of the same numbers.
  static void make_cone(v1::Node& node) {
    const v1::Segment s = node.segment();
    v1::Cone& c = *node.mutable_cone();
    *c.mutable_a() = s.a();
    *c.mutable_b() = s.b();
    c.set_radius_a(s.radius_a());
    c.set_radius_b(s.radius_b());
    c.set_range(s.range());
  }

  // Adds a half-space that nothing refers to, and returns its place. The node is not added to `unused_`.
  int add_half_space() {
    Part part;
    part.is_bounded = false;
    v1::HalfSpace& h = *part.node.mutable_half_space();
    set_point(h.mutable_point(), random_of_late_kinds_.point(-0.5, 0.5));
    set_point(h.mutable_normal(), random_of_late_kinds_.point(0.1, 1));
    h.set_range(random_of_late_kinds_.number(0.1, 0.8));
    const int place = add(std::move(part));
    unused_.pop_back();
    return place;
  }

  // Makes a signed primitive, or now and then a positive one made signed. The node is not added to `unused_`.
  int add_signed_operand() {
    add_primitive();
    const int primitive = unused_.back();
    unused_.pop_back();
    if (random_.chance(0.1)) {
      Part part;
      part.children = {primitive};
      part.node.mutable_harden();
      part.is_signed = true;
      add(std::move(part));
      const int hardened = unused_.back();
      unused_.pop_back();
      return hardened;
    }
    parts_[primitive].is_signed = true;
    v1::Node& node = parts_[primitive].node;
    google::protobuf::Message& body = kind_of(node);
    body.GetReflection()->ClearField(&body, body.GetDescriptor()->FindFieldByName("range"));
    body.GetReflection()->SetEnumValue(&body, body.GetDescriptor()->FindFieldByName("law"), v1::SIGNED);
    return primitive;
  }

  // Adds one or two operators of signed fields under a conversion to a positive one.
  void add_signed_tree() {
    std::vector<int> operands;
    const int count = random_.chance(0.6) ? 2 : random_.integer(2, 5);
    for (int i = 0; i < count; ++i) operands.push_back(add_signed_operand());
    int result = add_signed_operator(operands);
    if (random_.chance(0.4)) result = add_signed_operator({result, add_signed_operand()});
    Part part;
    part.children = {result};
    part.node.mutable_soften()->set_range(length());
    add(std::move(part));
  }

  v1::Form form() {
    if (!options_.cuts || random_.chance(0.6)) return v1::UNION;
    return random_.chance(0.5) ? v1::INTERSECTION : v1::DIFFERENCE;
  }

  int add_signed_operator(std::vector<int> operands) {
    Part part;
    part.is_signed = true;
    const auto count = static_cast<int>(operands.size());
    part.children = std::move(operands);
    v1::Node& node = part.node;
    switch (random_.integer(0, count == 2 ? 8 : 6)) {
      case 0:
        node.mutable_r_union()->set_form(form());
        break;
      case 1:
        node.mutable_pasko()->set_a0(random_.number(-0.2, 0.1));
        node.mutable_pasko()->set_a1(length());
        node.mutable_pasko()->set_a2(length());
        node.mutable_pasko()->set_form(form());
        break;
      case 2: {
        v1::FunctionalBlend& f = *node.mutable_functional();
        const double h = random_.number(0.05, 0.3);
        for (const double x : {0.0, 0.15, 0.3, 0.6}) f.add_x(x + random_.number(0, 0.1));
        for (const double y : {2.0, 1.0, 0.3, 0.0}) f.add_h(h * y);
        f.set_form(form());
        break;
      }
      case 3:
        options_.cuts&& random_.chance(0.5) ? void(node.mutable_max()) : void(node.mutable_min());
        if (node.has_min() && late_chance(0.4)) {
          node.mutable_smooth_min()->set_radius(random_of_late_kinds_.number(0.1, 0.8));
          if (options_.cuts && late_chance(0.4)) node.mutable_smooth_min()->set_form(v1::DIFFERENCE);
        }
        break;
      case 4: {
        v1::SuperellipticBlend& s = *node.mutable_superelliptic();
        s.set_exponent(random_.number(1.5, 4));
        for (int i = 0; i < count; ++i) s.add_ranges(length());
        s.set_by_angle(count == 2 && random_.chance(0.3));
        s.set_form(form());
        break;
      }
      case 5:
      case 6: {
        v1::Btk& b = *node.mutable_btk();
        const bool each = random_.chance(0.7);
        for (int i = 0; i < (each ? count : 1); ++i) {
          b.add_ranges(length());
          b.add_powers(random_.number(1.5, 4));
          b.add_weights(random_.chance(0.3) ? 1 : random_.number(0.3, 2));
        }
        b.set_eliminate_bulge(count == 2 && random_.chance(0.3));
        b.set_form(form());
        break;
      }
      default: {
        v1::Bt2& b = *node.mutable_bt2();
        b.set_r1(length());
        b.set_r2(length());
        b.set_p(random_.number(-1, 0.8) * b.r1() * b.r2());
        if (random_.chance(0.6)) b.set_m1(random_.number(0.3, 2));
        if (random_.chance(0.6)) b.set_m2(random_.number(0.3, 2));
        b.set_eliminate_bulge(random_.chance(0.3));
        b.set_form(form());
      }
    }
    add(std::move(part));
    const int place = unused_.back();
    unused_.pop_back();
    return place;
  }

  // Makes one of the operators of Barthe and Bernhardt.
  void fill_classic(v1::Node& node) {
    switch (random_.integer(0, 2)) {
      case 0:
        node.mutable_clean()->set_form(form());
        break;
      case 1:
        node.mutable_barthe()->set_theta1(random_.number(0, 45));
        node.mutable_barthe()->set_theta2(random_.number(0, 45));
        node.mutable_barthe()->set_form(form());
        break;
      default:
        node.mutable_bernhardt()->set_theta1(random_.number(0, 45));
        node.mutable_bernhardt()->set_theta2(random_.number(0, 45));
        node.mutable_bernhardt()->set_weight(random_.number(0, 1));
        node.mutable_bernhardt()->set_form(form());
    }
  }

  static google::protobuf::Message& kind_of(v1::Node& node) {
    const auto* reflection = node.GetReflection();
    return *reflection->MutableMessage(
        &node, reflection->GetOneofFieldDescriptor(node, v1::Node::descriptor()->FindOneofByName("kind")));
  }

  int take_unused() {
    const int place = random_.integer(0, static_cast<int>(unused_.size()) - 1);
    const int part = unused_[place];
    unused_.erase(unused_.begin() + place);
    return part;
  }

  // Adds a transform or an operator over nodes that no node refers to yet, and sometimes over one that is in use.
  void add_above() {
    if (options_.transforms && random_.chance(0.25)) {
      const int child = take_unused();
      if (parts_[child].transforms < kMostTransformsAbove) {
        add_transform(child);
        return;
      }
      unused_.push_back(child);
    }
    std::vector<int> children;
    const int count = random_.chance(0.7) ? 2 : random_.integer(1, 5);
    while (static_cast<int>(children.size()) < count && !unused_.empty()) children.push_back(take_unused());
    if (options_.sharing && random_.chance(0.15)) {
      const int other = random_.integer(0, static_cast<int>(parts_.size()) - 1);
      const bool is_shareable = !parts_[other].is_signed && parts_[other].is_bounded;
      int instances = is_shareable ? parts_[other].instances : kMostInstances;
      for (const int child : children) instances += parts_[child].instances;
      if (instances <= kMostInstances / 4) {
        children.push_back(other);
        std::erase(unused_, other);
      }
    }
    add_operator(std::move(children));
  }

  void add_transform(int child) {
    Part part;
    part.children = {child};
    v1::Transform& t = *part.node.mutable_transform();
    if (random_.chance(0.2)) {  // shear
      const blobtree::dvec3 offset = random_.point(-0.3, 0.3);
      const double offsets[] = {offset.x, offset.y, offset.z};
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          t.add_matrix(row == column ? random_.number(0.7, 1.4) : random_.number(-0.25, 0.25));
        }
        t.add_matrix(offsets[row]);
      }
      add(std::move(part));
      return;
    }
    if (random_.chance(0.8)) set_point(t.mutable_translation(), random_.point(-0.3, 0.3));
    if (random_.chance(0.6)) {
      set_point(t.mutable_rotation(), random_.point(0.1, 1));
      t.add_rotation(random_.number(-180, 180));
    }
    const double kind = random_.number(0, 1);
    if (kind < 0.3) {
      t.add_scale(random_.number(0.6, 1.6));
    } else if (kind < 0.6) {
      set_point(t.mutable_scale(), random_.point(0.6, 1.6));
      if (random_.chance(0.3)) t.set_scale(random_.integer(0, 2), -random_.number(0.6, 1.6));
    }
    add(std::move(part));
  }

  void add_operator(std::vector<int> children) {
    Part part;
    part.children = std::move(children);
    const double kind = random_.number(0, options_.cuts ? 1 : 0.7);
    if (options_.all_operators && part.children.size() >= 2 && random_.chance(0.15)) {
      fill_classic(part.node);
    } else if (kind < 0.4) {
      fill_gradient(*part.node.mutable_gradient());
      if (options_.all_operators && part.children.size() >= 2) part.node.mutable_gradient()->set_form(form());
    } else if (kind < 0.55) {
      part.node.mutable_sum();
    } else if (kind < 0.7) {
      part.node.mutable_max();
    } else if (kind < 0.78) {
      part.node.mutable_ricci()->set_exponent(random_.chance(0.2) ? 1 : random_.number(1, 8));
    } else if (kind < 0.86) {
      part.node.mutable_min();
    } else if (part.children.size() >= 2) {
      part.node.mutable_difference();
    } else {
      part.node.mutable_max();
    }
    if ((part.node.has_min() || part.node.has_difference()) && late_chance(0.3)) {
      part.children.push_back(add_half_space());
    }
    add(std::move(part));
  }

  void fill_gradient(v1::GradientBlend& g) {
    if (random_.chance(0.4)) {
      g.mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
      g.mutable_silhouette()->set_k(random_.number(0.1, 0.9));
    } else if (options_.all_operators && random_.chance(0.2)) {
      for (const double s :
           {1.0, random_.number(0.98, 1.03), random_.number(1.0, 1.15), random_.number(0.98, 1.03), 1.0}) {
        g.mutable_silhouette()->add_samples(s);
      }
    } else if (random_.chance(0.5)) {
      g.mutable_silhouette()->set_kind(v1::Silhouette::SMOOTH);
    }
    const double kind = random_.number(0, 1);
    if (kind < 0.1) return;  // the default
    v1::Opening& o = *g.mutable_opening();
    if (options_.all_operators && random_.chance(0.15)) {
      for (int i = 0; i < 6; ++i) o.add_samples(random_.number(0, 45));
      return;
    }
    if (kind < 0.7) {
      o.set_preset(static_cast<v1::Opening::Preset>(random_.integer(1, 3)));
      if (random_.chance(0.3)) o.set_theta1(random_.number(0, 45));
      return;
    }
    o.set_alpha0(random_.number(0, 50));
    o.set_alpha1(random_.number(60, 110));
    o.set_alpha2(random_.number(120, 180));
    o.set_theta0(random_.number(0, 45));
    o.set_theta1(random_.number(0, 45));
    o.set_theta2(random_.number(0, 45));
    o.set_w0(random_.number(0.5, 3));
    o.set_w1(random_.number(0.5, 3));
  }

  // Returns the nodes in any order. They refer to each other by name or by place.
  v1::Scene shuffled() {
    const int count = static_cast<int>(parts_.size());
    std::vector<int> place(count);
    std::iota(place.begin(), place.end(), 0);
    for (int i = count - 1; i > 0; --i) std::swap(place[i], place[random_.integer(0, i)]);
    std::vector<std::string> reference(count);
    for (int i = 0; i < count; ++i) {
      reference[i] = absl::StrCat("#", place[i]);
      if (random_.chance(0.5)) {
        reference[i] = absl::StrCat("group/part_", i);
        parts_[i].node.set_name(reference[i]);
      }
    }
    v1::Scene scene;
    for (int i = 0; i < count; ++i) scene.add_nodes();
    for (int i = 0; i < count; ++i) {
      for (const int child : parts_[i].children) add_reference(parts_[i].node, reference[child]);
      *scene.mutable_nodes(place[i]) = parts_[i].node;
    }
    scene.set_root(reference[count - 1]);
    return scene;
  }

  static void add_reference(v1::Node& node, const std::string& child) {
    google::protobuf::Message& body = kind_of(node);
    const auto* field = body.GetDescriptor()->FindFieldByNumber(1);  // children, or child
    if (field->is_repeated()) {
      body.GetReflection()->AddString(&body, field, child);
    } else {
      body.GetReflection()->SetString(&body, field, child);
    }
  }

  Random random_;
  // Draws cones, half-spaces and smooth minima, so that a scene without them stays the same whether or not they exist.
  Random random_of_late_kinds_;
  RandomSceneOptions options_;
  std::vector<Part> parts_;
  std::vector<int> unused_;  // parts that nothing refers to
};

}  // namespace

v1::Scene random_scene(std::uint64_t seed, const RandomSceneOptions& options) {
  return SceneMaker(seed, options).make();
}

}  // namespace isofield::test_support
