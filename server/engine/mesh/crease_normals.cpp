#include "engine/mesh/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/mesh_sides.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

// The cosine of 15 degrees. Triangles deviate from curved sides by some degrees. So a crease goes on along edges that
// turn by 15 to 25 degrees, if the normal at one of their ends is that of a side.
constexpr double kLeastAlong = 0.9659258262890683;
// The cosine of 12.5 degrees. If two triangles turn by 25 degrees at an edge, one of them faces at least half of that
// away from the normal at either end.
constexpr double kHalfTurn = 0.9762960071199334;
// If an edge lies on a curved surface, the normals at its ends lie midway between those of its two triangles, and the
// normals at the two opposite corners turn by twice as much as the triangles. If it is a crease, the normal at an end
// is that of one side, and the opposite corners' normals turn by as much as the triangles; near a second crease they
// may be arbitrary. The first number is a part of the triangles' turn, the second a part of the corners' turn.
constexpr double kMostOfTurn = 0.85, kLeastOfCorners = 0.9;
// On a seam, which turns by less than a crease, the mesher gives vertices the mean of both sides' normals. An edge is
// smooth if the normals at both its ends are at most this part of the turn away from either triangle's.
constexpr double kMeanOfTurn = 0.7;
// A unit normal with less than this length across the edge tells nothing about the sides of the edge.
constexpr double kLeastAcross = 0.1;
constexpr std::uint32_t kNoWedge = std::numeric_limits<std::uint32_t>::max();

double angle(const dvec3& a, const dvec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// kMayGoOn: the edge belongs to a crease if it is in a row with a crease.
enum class EdgeKind : std::uint8_t { kSmooth, kMayGoOn, kCrease };

// Looks only at the triangles around vertices that creases may pass through, which are few in most meshes, and numbers
// their corners anew.
class CreaseFinder {
 public:
  explicit CreaseFinder(const Mesh& mesh) : mesh_(mesh) {
    choose();
    twins_ = find_twins(corners_, mesh_.positions.size() / 3);
    directions_ = face_directions(mesh_.positions, corners_, twins_);
  }

  CreaseNormals normals() {
    DisjointSets sides = find_sides();
    const std::vector<bool> is_split = split_vertices(sides);
    CreaseNormals out;
    std::vector<std::uint32_t> wedge_of(corners_.size()), first_wedges(is_split.size(), kNoWedge);
    std::vector<dvec3> sums;  // the sum of each wedge's normals
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const std::uint32_t vertex = corners_[c];
      if (!is_split[vertex]) continue;
      const std::uint32_t first = sides.root(c);
      if (first == c) {
        wedge_of[c] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(vertex);
        sums.emplace_back();
        if (first_wedges[vertex] == kNoWedge) first_wedges[vertex] = wedge_of[c];
      }
      const std::uint32_t wedge = wedge_of[c] = wedge_of[first];
      if (wedge != first_wedges[vertex]) out.corners.insert(out.corners.end(), {3 * numbers_[c / 3] + c % 3, wedge});
      sums[wedge] = sums[wedge] + directions_[c / 3] * angle_at(c);
    }
    for (std::size_t wedge = 0; wedge < sums.size(); ++wedge) {
      const double size = length(sums[wedge]);
      const dvec3 n = size > 0 ? sums[wedge] * (1 / size) : position_of(mesh_.normals, out.vertices[wedge]);
      for (const double x : {n.x, n.y, n.z}) out.normals.push_back(static_cast<float>(x));
    }
    return out;
  }

 private:
  dvec3 position(std::uint32_t corner) const { return position_of(mesh_.positions, corners_[corner]); }
  dvec3 normal(std::uint32_t corner) const { return position_of(mesh_.normals, corners_[corner]); }
  double angle_at(std::uint32_t corner) const {
    const std::uint32_t after = next_corner(corner);
    return angle(position(after) - position(corner), position(next_corner(after)) - position(corner));
  }

  void choose() {
    const std::vector<std::uint32_t>& all = mesh_.triangles;
    may_split_.resize(mesh_.positions.size() / 3);
    for (std::size_t t = 0; t < all.size(); t += 3) {
      const dvec3 n = normal_of(mesh_.positions, {all[t], all[t + 1], all[t + 2]});
      const double least = kHalfTurn * length(n);
      for (std::size_t c = t; c < t + 3; ++c) {
        if (dot(n, position_of(mesh_.normals, all[c])) <= least) may_split_[all[c]] = true;
      }
    }
    for (std::size_t t = 0; t < all.size(); t += 3) {
      if (!may_split_[all[t]] && !may_split_[all[t + 1]] && !may_split_[all[t + 2]]) continue;
      numbers_.push_back(static_cast<std::uint32_t>(t / 3));
      corners_.insert(corners_.end(), {all[t], all[t + 1], all[t + 2]});
    }
  }

  // Joins the corners at each vertex that lie on one side of its creases.
  DisjointSets find_sides() {
    const std::vector<EdgeKind> kinds = find_creases();
    DisjointSets sides(corners_.size());
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      if (kinds[c] == EdgeKind::kCrease) return;
      if (may_split_[corners_[c]]) sides.join(c, next_corner(d));
      if (may_split_[corners_[d]]) sides.join(next_corner(c), d);
    });
    return sides;
  }

  // Finds the vertices that have more than one side.
  std::vector<bool> split_vertices(DisjointSets& sides) const {
    std::vector<bool> has_side(may_split_.size()), is_split(may_split_.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const std::uint32_t vertex = corners_[c];
      if (!may_split_[vertex] || sides.root(c) != c) continue;
      if (has_side[vertex]) is_split[vertex] = true;
      has_side[vertex] = true;
    }
    return is_split;
  }

  // Visits each edge that has two half-edges, by the corners at which they begin.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    for (std::uint32_t c = 0; c < twins_.size(); ++c) {
      if (twins_[c] != kNoTwin && c < twins_[c]) visit(c, twins_[c]);
    }
  }

  // Returns the kinds of edges; the kind of an edge is stored at the first of its two corners. It leaves true in
  // may_split_ only for vertices with at least two edges on creases, which divide their triangles into sides.
  std::vector<EdgeKind> find_creases() {
    std::vector<EdgeKind> kinds(twins_.size(), EdgeKind::kSmooth);
    std::vector<std::uint32_t> creases(may_split_.size());  // the number of crease edges at each vertex
    DisjointSets rows(may_split_.size());                   // joins the vertices along edges that may be creases
    const auto count = [&](std::uint32_t c, std::uint32_t d) { ++creases[corners_[c]], ++creases[corners_[d]]; };
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      kinds[c] = kind_of(c, d);
      if (kinds[c] == EdgeKind::kCrease) count(c, d);
      if (kinds[c] != EdgeKind::kSmooth) rows.join(corners_[c], corners_[d]);
    });
    std::vector<bool> has_crease(rows.size());  // by the root of each row
    for (std::uint32_t v = 0; v < rows.size(); ++v) {
      if (creases[v] > 1) has_crease[rows.root(v)] = true;
    }
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      if (kinds[c] != EdgeKind::kMayGoOn || !has_crease[rows.root(corners_[c])]) return;
      kinds[c] = EdgeKind::kCrease;
      count(c, d);
    });
    for (std::size_t v = 0; v < creases.size(); ++v) may_split_[v] = creases[v] > 1;
    return kinds;
  }

  EdgeKind kind_of(std::uint32_t c, std::uint32_t d) const {
    const dvec3 &f = directions_[c / 3], &g = directions_[d / 3];
    if (dot(f, g) > kLeastAlong) return EdgeKind::kSmooth;
    const double turn = angle(f, g);
    const dvec3 edge = position(next_corner(c)) - position(c);
    const double size = length(edge);
    const dvec3 along = size > 0 ? edge * (1 / size) : dvec3{0, 0, 1};
    // Returns the angle between a normal and the triangle that is further from it, as a part of the turn.
    const auto part_of_turn = [&](const dvec3& n) {
      const dvec3 across = n - along * dot(n, along);
      return length(across) > kLeastAcross ? std::max(angle(across, f), angle(across, g)) / turn : 1;
    };
    const auto [least, most] = std::minmax({part_of_turn(normal(c)), part_of_turn(normal(next_corner(c)))});
    if (most <= kMeanOfTurn) return EdgeKind::kSmooth;
    if (dot(f, g) > kCreaseCosine) return most > kMostOfTurn ? EdgeKind::kMayGoOn : EdgeKind::kSmooth;
    const double corners = angle(normal(next_corner(next_corner(c))), normal(next_corner(next_corner(d))));
    return least > kMostOfTurn || turn >= kLeastOfCorners * corners ? EdgeKind::kCrease : EdgeKind::kSmooth;
  }

  const Mesh& mesh_;
  std::vector<bool> may_split_;         // by vertex
  std::vector<std::uint32_t> numbers_;  // the numbers of the chosen triangles in the mesh
  std::vector<std::uint32_t> corners_;  // the vertices of their corners
  std::vector<std::uint32_t> twins_;
  std::vector<dvec3> directions_;
};

}  // namespace

CreaseNormals crease_normals(const Mesh& mesh) {
  return CreaseFinder(mesh).normals();
}

}  // namespace isofield::engine
