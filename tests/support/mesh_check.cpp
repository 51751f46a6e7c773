#include "support/mesh_check.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace isofield::test_support {
namespace {

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A union-find structure over the numbers below `size`.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

 private:
  std::vector<std::uint32_t> parent_;
};

// A side of a triangle, from one corner to the next.
struct Side {
  std::uint64_t edge;    // the lower vertex and the higher vertex
  std::uint32_t corner;  // 3 * triangle + (0, 1 or 2)
  bool rising;           // from the lower vertex to the higher
};

std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

class Checker {
 public:
  Checker(std::span<const float> positions, std::span<const std::uint32_t> indices)
      : positions_(positions), vertex_count_(positions.size() / 3) {
    const std::size_t triangles = indices.size() / 3;
    corners_.reserve(3 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::uint32_t a = indices[3 * t], b = indices[3 * t + 1], c = indices[3 * t + 2];
      if (std::max({a, b, c}) >= vertex_count_) {
        ++report_.bad_indices;
      } else if (a == b || b == c || c == a) {
        ++report_.degenerate_triangles;
      } else {
        corners_.insert(corners_.end(), {a, b, c});
      }
    }
    report_.triangles = triangles;
  }

  MeshReport run() {
    check_vertices();
    check_shape();
    check_edges();
    return report_;
  }

 private:
  Point point(std::uint32_t vertex) const {
    const float* p = &positions_[3 * std::size_t{vertex}];
    return {p[0], p[1], p[2]};
  }

  void check_vertices() {
    std::vector<char> used(vertex_count_, 0);
    for (const std::uint32_t v : corners_) used[v] = 1;
    report_.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
    report_.unused_vertices = vertex_count_ - report_.vertices;
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      const Point p = point(static_cast<std::uint32_t>(v));
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) ++report_.not_finite;
    }
  }

  void check_shape() {
    if (corners_.empty()) return;
    const Point origin = point(corners_[0]);  // keeps the volume's terms small
    for (std::size_t t = 0; t < corners_.size(); t += 3) {
      const Point a = minus(point(corners_[t]), origin), b = minus(point(corners_[t + 1]), origin),
                  c = minus(point(corners_[t + 2]), origin);
      report_.volume += dot(a, cross(b, c)) / 6;
      const Point ab = minus(b, a), ac = minus(c, a), bc = minus(c, b), normal = cross(ab, ac);
      const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
      if (std::sqrt(dot(normal, normal)) <= 1e-12 * longest) ++report_.zero_area;
    }
  }

  void check_edges() {
    std::vector<Side> sides;
    sides.reserve(corners_.size());
    for (std::uint32_t corner = 0; corner < corners_.size(); ++corner) {
      const std::uint32_t from = corners_[corner], to = corners_[next_corner(corner)];
      sides.push_back({std::uint64_t{std::min(from, to)} << 32 | std::max(from, to), corner, from < to});
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.corner < b.corner; });
    Sets fans(corners_.size()), parts(vertex_count_);
    std::int64_t edges = 0;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      end = begin + 1;
      while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
      ++edges;
      count_edge({&sides[begin], end - begin});
      for (std::size_t i = begin; i < end; ++i) {
        join_fans(fans, sides[begin], sides[i]);
        parts.join(corners_[sides[i].corner], corners_[next_corner(sides[i].corner)]);
      }
    }
    count_fans(fans);
    for (std::uint32_t v = 0; v < vertex_count_; ++v) report_.components += parts.find(v) == v ? 1 : 0;
    report_.components -= report_.unused_vertices;
    report_.euler =
        static_cast<std::int64_t>(report_.vertices) - edges + static_cast<std::int64_t>(corners_.size() / 3);
  }

  void count_edge(std::span<const Side> uses) {
    if (uses.size() == 1) ++report_.open_edges;
    if (uses.size() == 2 && uses[0].rising == uses[1].rising) ++report_.flipped_edges;
    if (uses.size() > 2) ++report_.crowded_edges;
  }

  // Joins the corners of two triangles at both ends of the edge that they share.
  static void join_fans(Sets& fans, const Side& a, const Side& b) {
    const auto low = [](const Side& s) { return s.rising ? s.corner : next_corner(s.corner); };
    const auto high = [](const Side& s) { return s.rising ? next_corner(s.corner) : s.corner; };
    fans.join(low(a), low(b));
    fans.join(high(a), high(b));
  }

  void count_fans(Sets& fans) {
    std::vector<char> count(vertex_count_, 0);
    for (std::uint32_t corner = 0; corner < corners_.size(); ++corner) {
      if (fans.find(corner) != corner) continue;
      char& fans_here = count[corners_[corner]];
      if (fans_here == 1) ++report_.pinched_vertices;
      fans_here = static_cast<char>(std::min(fans_here + 1, 2));
    }
  }

  std::span<const float> positions_;
  std::size_t vertex_count_;
  std::vector<std::uint32_t> corners_;  // vertices of the triangles that are looked at
  MeshReport report_;
};

}  // namespace

std::string MeshReport::text() const {
  return absl::StrCat(sound() ? "sound" : "NOT sound", ": ", vertices, " vertices (", unused_vertices, " unused, ",
                      not_finite, " not finite), ", triangles, " triangles (", bad_indices, " with bad indices, ",
                      degenerate_triangles, " degenerate, ", zero_area, " of no area), ", open_edges, " open, ",
                      flipped_edges, " flipped and ", crowded_edges, " crowded edges, ", pinched_vertices,
                      " pinched vertices, ", components, " components, genus ", genus(), ", volume ", volume);
}

MeshReport check_mesh(std::span<const float> positions, std::span<const std::uint32_t> indices) {
  return Checker(positions, indices).run();
}

}  // namespace isofield::test_support
