#include "mesh_files/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "render/unit_vector.h"

namespace isofield {
namespace {

// Cosines of 25 degrees and of 15. Triangles lean over curved sides by some degrees, so a crease is taken to go on along
// edges that turn by less, if the normal at one of their ends is that of a side.
constexpr float kLeastTurn = 0.90630779f, kLeastAlong = 0.96592583f;
// Of the two triangles at such an edge one faces at least half of that away from the normal at either end: cosine.
constexpr float kHalfTurn = 0.97629601f;
// Across an edge of a curved surface the normals at its ends lie midway between those of its triangles, and the normals
// at the corners that face it turn by twice as much as the triangles. At a crease a normal is that of one side, and the
// corners' turn by as much as the triangles; where creases are near one another they may say anything.
constexpr float kMostOfTurn = 0.85f, kLeastOfCorners = 0.9f;
// The server gives vertices on seams, which turn by less than a crease, the mean of both sides' normals.
constexpr float kMeanOfTurn = 0.7f;
// Of a unit normal, what is left without its part along the edge.
constexpr float kLeastAcross = 0.1f;
// Height by longest edge: thinner triangles, whose own direction says little, take that of the one at that edge.
constexpr float kThin = 0.06f;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint32_t next(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

float angle(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

class Creases {
 public:
  explicit Creases(const Mesh& mesh) : mesh_(mesh) {
    choose();
    find_opposites();
    find_directions();
    parents_.resize(triangles_.size());
    std::iota(parents_.begin(), parents_.end(), 0u);
    const std::vector<EdgeKind> kinds = find_creases();
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      if (kinds[c] == EdgeKind::kCrease) return;
      if (may_split_[triangles_[c]]) join(parents_, c, next(d));
      if (may_split_[triangles_[d]]) join(parents_, next(c), d);
    });
  }

  CreaseNormals normals() {
    const std::size_t vertices = mesh_.vertex_count();
    CreaseNormals out{.normals = mesh_.normals, .corners = mesh_.triangles};
    std::vector<std::uint32_t> normals(parents_.size());      // of corners
    std::vector<std::uint32_t> first_sides(vertices, kNone);  // by their roots
    std::vector<bool> is_split(vertices);
    for (std::uint32_t c = 0; c < parents_.size(); ++c) {
      const std::uint32_t vertex = triangles_[c];
      if (!may_split_[vertex]) continue;
      const std::uint32_t side = root(parents_, c);
      if (side != c) {
        normals[c] = normals[side];  // a root is the first of its side
      } else if (first_sides[vertex] == kNone) {
        first_sides[vertex] = c;
        normals[c] = vertex;
      } else {
        is_split[vertex] = true;
        normals[c] = static_cast<std::uint32_t>(vertices + out.vertices.size());
        out.vertices.push_back(vertex);
      }
    }
    out.normals.resize(mesh_.normals.size() + 3 * out.vertices.size());
    std::vector<glm::vec3> sums(vertices + out.vertices.size());
    for (std::uint32_t c = 0; c < parents_.size(); ++c) {
      if (!is_split[triangles_[c]]) continue;
      out.corners[3 * std::size_t{numbers_[c / 3]} + c % 3] = normals[c];
      const glm::vec3 p = position(c), along = position(next(c)) - p, back = position(next(next(c))) - p;
      glm::vec3& sum = sums[normals[c]];
      sum += directions_[c / 3] * angle(along, back);
    }
    for (std::size_t n = 0; n < sums.size(); ++n) {
      const float size = glm::length(sums[n]);
      if (size > 0) {
        const glm::vec3 unit = sums[n] * (1 / size);
        std::copy_n(std::begin({unit.x, unit.y, unit.z}), 3, &out.normals[3 * n]);
      }
    }
    return out;
  }

 private:
  glm::vec3 position(std::uint32_t corner) const { return at(mesh_.positions, triangles_[corner]); }
  glm::vec3 normal(std::uint32_t corner) const { return at(mesh_.normals, triangles_[corner]); }
  static glm::vec3 at(const std::vector<float>& rows, std::uint32_t row) {
    const float* r = &rows[3 * std::size_t{row}];
    return {r[0], r[1], r[2]};
  }

  // The triangles around vertices that creases may pass through: of most meshes few.
  void choose() {
    const auto& all = mesh_.triangles;
    may_split_.resize(mesh_.vertex_count());
    for (std::size_t t = 0; t < all.size(); t += 3) {
      const glm::vec3 a = at(mesh_.positions, all[t]);
      const glm::vec3 n = glm::cross(at(mesh_.positions, all[t + 1]) - a, at(mesh_.positions, all[t + 2]) - a);
      const float least = kHalfTurn * glm::length(n);
      for (std::size_t c = t; c < t + 3; ++c) {
        if (glm::dot(n, at(mesh_.normals, all[c])) <= least) may_split_[all[c]] = true;
      }
    }
    for (std::size_t t = 0; t < all.size(); t += 3) {
      if (!may_split_[all[t]] && !may_split_[all[t + 1]] && !may_split_[all[t + 2]]) continue;
      numbers_.push_back(static_cast<std::uint32_t>(t / 3));
      triangles_.insert(triangles_.end(), {all[t], all[t + 1], all[t + 2]});
    }
  }

  // Of the side of a triangle that begins at a corner, where its opposite begins.
  void find_opposites() {
    opposites_.assign(triangles_.size(), kNone);
    std::vector<std::uint32_t> starts(mesh_.vertex_count() + 1), sides(triangles_.size());  // by their first vertex
    for (const std::uint32_t v : triangles_) ++starts[v + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> ends(starts.begin(), starts.end() - 1);
    for (std::uint32_t c = 0; c < triangles_.size(); ++c) sides[ends[triangles_[c]]++] = c;
    for (std::uint32_t c = 0; c < triangles_.size(); ++c) {
      const std::uint32_t from = triangles_[next(c)];
      for (std::uint32_t i = starts[from]; i < starts[from + 1]; ++i) {
        if (triangles_[next(sides[i])] == triangles_[c]) opposites_[c] = sides[i];
      }
    }
  }

  void find_directions() {
    const std::size_t count = opposites_.size() / 3;
    std::vector<glm::vec3> own(count);
    std::vector<std::uint32_t> beside(count, kNone);  // of thin ones
    for (std::uint32_t t = 0; t < count; ++t) {
      const glm::vec3 a = position(3 * t), b = position(3 * t + 1), c = position(3 * t + 2);
      const glm::vec3 n = glm::cross(b - a, c - a);
      const float edges[] = {glm::length(b - a), glm::length(c - b), glm::length(a - c)};
      const auto longest = std::max_element(edges, edges + 3);
      const float size = glm::length(n);
      if (size > 0) own[t] = n * (1 / size);
      const std::uint32_t across = opposites_[3 * t + static_cast<std::uint32_t>(longest - edges)];
      if (size < kThin * *longest * *longest && across != kNone) beside[t] = across / 3;
    }
    directions_.resize(count);
    for (std::uint32_t t = 0; t < count; ++t) {
      std::uint32_t from = t;
      for (int step = 0; step < 4 && beside[from] != kNone; ++step) from = beside[from];
      directions_[t] = own[beside[from] == kNone ? from : t];
    }
  }

  // kMayGoOn: part of a crease if it is in a row with one.
  enum class EdgeKind : std::uint8_t { kSmooth, kMayGoOn, kCrease };

  // Visits each inner edge by the corners at which its two sides begin.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    for (std::uint32_t c = 0; c < opposites_.size(); ++c) {
      if (opposites_[c] != kNone && c < opposites_[c]) visit(c, opposites_[c]);
    }
  }

  // Returns the kinds of edges, each at the corner that is visited first. It leaves in may_split_ the vertices that have
  // sides: those that a crease passes by two of their edges.
  std::vector<EdgeKind> find_creases() {
    std::vector<EdgeKind> kinds(opposites_.size(), EdgeKind::kSmooth);
    std::vector<std::uint32_t> creases(may_split_.size());  // around each vertex
    std::vector<std::uint32_t> rows(may_split_.size());     // of edges that may be creases, by a vertex each
    std::iota(rows.begin(), rows.end(), 0u);
    const auto count = [&](std::uint32_t c, std::uint32_t d) { ++creases[triangles_[c]], ++creases[triangles_[d]]; };
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      kinds[c] = kind_of(c, d);
      if (kinds[c] == EdgeKind::kCrease) count(c, d);
      if (kinds[c] != EdgeKind::kSmooth) join(rows, triangles_[c], triangles_[d]);
    });
    std::vector<bool> has_crease(rows.size());  // by the rows' roots
    for (std::uint32_t v = 0; v < rows.size(); ++v) {
      if (creases[v] > 1) has_crease[root(rows, v)] = true;
    }
    for_edges([&](std::uint32_t c, std::uint32_t d) {
      if (kinds[c] != EdgeKind::kMayGoOn || !has_crease[root(rows, triangles_[c])]) return;
      kinds[c] = EdgeKind::kCrease;
      count(c, d);
    });
    for (std::size_t v = 0; v < creases.size(); ++v) may_split_[v] = creases[v] > 1;
    return kinds;
  }

  EdgeKind kind_of(std::uint32_t c, std::uint32_t d) const {
    const glm::vec3 &f = directions_[c / 3], &g = directions_[d / 3];
    if (glm::dot(f, g) > kLeastAlong) return EdgeKind::kSmooth;
    const float turn = angle(f, g);
    const glm::vec3 along = unit_vector(position(next(c)) - position(c));
    // The angle between the normal and the further triangle, as a part of the turn.
    const auto part_of_turn = [&](const glm::vec3& n) {
      const glm::vec3 across = n - along * glm::dot(n, along);
      return glm::length(across) > kLeastAcross ? std::max(angle(across, f), angle(across, g)) / turn : 1;
    };
    const auto [least, most] = std::minmax({part_of_turn(normal(c)), part_of_turn(normal(next(c)))});
    if (most <= kMeanOfTurn) return EdgeKind::kSmooth;
    if (glm::dot(f, g) > kLeastTurn) return most > kMostOfTurn ? EdgeKind::kMayGoOn : EdgeKind::kSmooth;
    const float corners = angle(normal(next(next(c))), normal(next(next(d))));
    return least > kMostOfTurn || turn >= kLeastOfCorners * corners ? EdgeKind::kCrease : EdgeKind::kSmooth;
  }

  static std::uint32_t root(std::vector<std::uint32_t>& parents, std::uint32_t c) {
    while (parents[c] != c) c = parents[c] = parents[parents[c]];
    return c;
  }
  static void join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
    a = root(parents, a), b = root(parents, b);
    parents[std::max(a, b)] = std::min(a, b);
  }

  const Mesh& mesh_;
  std::vector<bool> may_split_;                     // vertices
  std::vector<std::uint32_t> numbers_, triangles_;  // of the chosen triangles, and their vertices
  std::vector<std::uint32_t> opposites_;            // of corners
  std::vector<glm::vec3> directions_;                  // of triangles
  std::vector<std::uint32_t> parents_;              // corners at a vertex that lie on one side
};

}  // namespace

CreaseNormals crease_normals(const Mesh& mesh) {
  return Creases(mesh).normals();
}

Mesh split_at_creases(Mesh mesh) {
  if (mesh.normals.empty()) return mesh;
  CreaseNormals split = crease_normals(mesh);
  if (split.vertices.empty()) return mesh;
  mesh.positions.reserve(split.normals.size());
  for (const std::uint32_t v : split.vertices) {
    for (std::size_t i = 0; i < 3; ++i) mesh.positions.push_back(mesh.positions[3 * std::size_t{v} + i]);
  }
  mesh.normals = std::move(split.normals);
  mesh.triangles = std::move(split.corners);
  return mesh;
}

}  // namespace isofield
