// Gives one node of every kind of primitive, as JSON.
#pragma once

#include <absl/strings/str_cat.h>

#include <string>
#include <vector>

namespace isofield::test_support {

struct PrimitiveNode {
  const char* kind;  // the field of the message Node
  const char* body;  // the node's body without law and range
  bool is_bounded = true;

  // Returns {"name": "NAME", "KIND": {BODY, range or law}}.
  std::string text(const std::string& name, bool is_signed) const {
    return absl::StrCat(R"({"name": ")", name, R"(", ")", kind, R"(": {)", body,
                        is_signed ? R"(, "law": "SIGNED"}})" : R"(, "range": 0.6}})");
  }
};

inline const std::vector<PrimitiveNode>& primitive_nodes() {
  static const std::vector<PrimitiveNode> kNodes{
      {"sphere", R"("center": [0.1, -0.2, 0.3], "radius": 0.7)"},
      {"segment", R"("a": [-0.5, 0.1, 0], "b": [0.6, 0.4, 0.2], "radius_a": 0.5, "radius_b": 0.2)"},
      {"box", R"("half_size": [0.7, 0.5, 0.4], "rounding": 0.1)"},
      {"cylinder", R"("a": [-0.4, 0, -0.3], "b": [0.5, 0.2, 0.4], "radius": 0.45)"},
      {"torus", R"("axis": [1, 2, 2], "major_radius": 0.8, "minor_radius": 0.25)"},
      {"ellipsoid", R"("center": [0, 0.1, 0], "semi_axes": [0.9, 0.6, 0.4])"},
      {"half_space", R"("point": [0.1, 0.2, -0.1], "normal": [1, -2, 2])", false},
      {"cone", R"("a": [-0.4, 0.1, -0.5], "b": [0.5, 0, 0.4], "radius_a": 0.6, "radius_b": 0.2)"},
  };
  return kNodes;
}

}  // namespace isofield::test_support
