#include "engine/mesh/mesh_shells.h"

#include <absl/container/flat_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "blobtree/tape/tape.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

constexpr std::uint32_t kNoVertex = ~0u;

// Returns a function that receives corners one by one, and calls take(triangle) after each third one.
template <class Take>
auto by_triangle(const Take& take) {
  return [&take, t = Triangle{}](std::size_t corner, std::uint32_t vertex) mutable {
    t[corner % 3] = vertex;
    if (corner % 3 == 2) take(t);
  };
}

// Numbers the sets in the order of their lowest members, and returns the number of each vertex's shell.
std::vector<std::uint32_t> number_shells(DisjointSets& sets, std::uint32_t& shells) {
  std::vector<std::uint32_t> numbers(sets.size());
  shells = 0;
  for (std::uint32_t v = 0; v < sets.size(); ++v) {
    const std::uint32_t root = sets.root(v);
    numbers[v] = root == v ? shells++ : numbers[root];
  }
  return numbers;
}

struct Shell {
  double volume = 0, area = 0;
  std::uint32_t vertex = kNoVertex;  // one of its vertices

  bool is_void() const { return volume < 0; }
  bool is_sliver(double cell_size) const { return 2 * std::abs(volume) < kSliverCells * cell_size * area; }
};

// Adds what a triangle encloses to its shell.
void add(const Triangle& t, std::span<const float> positions, Shell& shell) {
  // The tetrahedra have their apex at a vertex of the shell, because far from the origin their volumes would cancel.
  if (shell.vertex == kNoVertex) shell.vertex = t[0];
  const dvec3 normal = normal_of(positions, t);
  shell.volume += dot(position_of(positions, t[0]) - position_of(positions, shell.vertex), normal) / 6;
  shell.area += length(normal) / 2;
}

ShellCounts count(std::span<const float> positions, std::span<const Shell> shells, double cell_size) {
  ShellCounts counts;
  double largest = -1;
  for (const Shell& shell : shells) {
    ++(shell.is_void() ? counts.voids : counts.bodies);
    if (!shell.is_sliver(cell_size)) continue;
    ++(shell.is_void() ? counts.sliver_voids : counts.sliver_bodies);
    if (std::abs(shell.volume) <= largest) continue;
    largest = std::abs(shell.volume);
    std::copy_n(&positions[3 * std::size_t{shell.vertex}], 3, counts.sliver.begin());
  }
  return counts;
}

// Finds the shells that points lie in. A point lies in a shell if a ray from it along x leaves the shell more often, or
// less often, than it enters it.
class Nesting {
 public:
  Nesting(const Mesh& mesh, std::span<const std::uint32_t> shell_of) : mesh_(mesh), shell_of_(shell_of) {
    for (std::uint32_t v = 0; v < mesh.positions.size() / 3; ++v) {
      const dvec3 p = position_of(mesh.positions, v);
      box_.add({p, p});
    }
    cell_ = std::max({box_.max.y - box_.min.y, box_.max.z - box_.min.z, 1e-30}) / kCells;
  }

  // Adds a point of each wanted shell.
  void add_points(std::span<const char> is_wanted) {
    points_.resize(is_wanted.size());
    std::vector<char> is_placed(is_wanted.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); t += 3) {
      const std::uint32_t shell = shell_of_[mesh_.triangles[t]];
      if (!is_wanted[shell] || std::exchange(is_placed[shell], 1)) continue;
      // Simple fractions would not do, since rays in scenes with symmetries would meet vertices.
      points_[shell] = corner(t) * 0.3127 + corner(t + 1) * 0.2641 + corner(t + 2) * 0.4232;
      grid_[place(index(points_[shell].y, box_.min.y), index(points_[shell].z, box_.min.z))].push_back(shell);
    }
  }

  // Returns, for each shell that has a point, the shells around it.
  std::vector<std::vector<std::uint32_t>> find() {
    absl::flat_hash_map<std::pair<std::uint32_t, std::uint32_t>, int> windings;
    for (std::size_t t = 0; t < mesh_.triangles.size(); t += 3) {
      const std::uint32_t shell = shell_of_[mesh_.triangles[t]];
      const std::array<dvec3, 3> c{corner(t), corner(t + 1), corner(t + 2)};
      const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
      const auto [low_z, high_z] = std::minmax({c[0].z, c[1].z, c[2].z});
      for (int y = index(low_y, box_.min.y); y <= index(high_y, box_.min.y); ++y) {
        for (int z = index(low_z, box_.min.z); z <= index(high_z, box_.min.z); ++z) {
          const auto found = grid_.find(place(y, z));
          if (found == grid_.end()) continue;
          for (const std::uint32_t inner : found->second) {
            const int crossing = inner == shell ? 0 : cross_ray(points_[inner], c);
            if (crossing != 0) windings[{inner, shell}] += crossing;
          }
        }
      }
    }
    std::vector<std::vector<std::uint32_t>> around(points_.size());
    for (const auto& [pair, winding] : windings) {
      if (winding != 0) around[pair.first].push_back(pair.second);
    }
    return around;
  }

 private:
  static constexpr int kCells = 1024;  // along the longer edge of the grid

  dvec3 corner(std::size_t c) const { return position_of(mesh_.positions, mesh_.triangles[c]); }
  int index(double at, double low) const { return static_cast<int>((at - low) / cell_); }
  static std::uint32_t place(int y, int z) {
    return static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(z);
  }

  // Returns twice the area of the triangle a, b, p seen along x, positive if the three turn counter-clockwise. For b,
  // a, p it returns exactly the negative, so that a ray never meets both of two triangles at the edge that they share.
  static double turn(const dvec3& a, const dvec3& b, const dvec3& p) {
    const bool is_ordered = a.y < b.y || (a.y == b.y && a.z < b.z);
    const dvec3 &u = is_ordered ? a : b, &v = is_ordered ? b : a;
    const double area = (v.y - u.y) * (p.z - u.z) - (v.z - u.z) * (p.y - u.y);
    return is_ordered ? area : -area;
  }

  // Returns 1 if the ray from p along x leaves through the triangle, -1 if it enters, else 0.
  static int cross_ray(const dvec3& p, const std::array<dvec3, 3>& c) {
    const double a = turn(c[1], c[2], p), b = turn(c[2], c[0], p), d = turn(c[0], c[1], p);
    const bool leaves = a > 0 && b > 0 && d > 0, enters = a < 0 && b < 0 && d < 0;
    if (!leaves && !enters) return 0;
    if ((a * c[0].x + b * c[1].x + d * c[2].x) / (a + b + d) <= p.x) return 0;
    return leaves ? 1 : -1;
  }

  const Mesh& mesh_;
  const std::span<const std::uint32_t> shell_of_;
  blobtree::Box box_;
  double cell_ = 1;
  std::vector<dvec3> points_;                                            // by shell
  absl::flat_hash_map<std::uint32_t, std::vector<std::uint32_t>> grid_;  // shells by the place of their points
};

// Tells for each shell whether it stays.
std::vector<char> choose(const Mesh& mesh, std::span<const std::uint32_t> shell_of, std::span<const Shell> shells,
                         const ShellFilter& filter) {
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(shells.begin(), shells.end(),
                                                  [](const Shell& a, const Shell& b) { return a.volume < b.volume; }) -
                                 shells.begin());
  std::vector<char> stays(shells.size(), 0), asks(shells.size(), 0);
  if (filter.largest_body) stays[largest] = 1;
  if (filter.largest_body && filter.fill_voids) return stays;
  for (std::size_t s = 0; s < shells.size(); ++s) asks[s] = shells[s].is_void() == filter.largest_body;
  Nesting nesting(mesh, shell_of);
  nesting.add_points(asks);
  const std::vector<std::vector<std::uint32_t>> around = nesting.find();
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (!asks[s]) continue;
    const auto innermost = std::min_element(around[s].begin(), around[s].end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::abs(shells[a].volume) < std::abs(shells[b].volume);
    });
    const bool is_outermost = innermost == around[s].end();
    stays[s] = filter.largest_body ? !is_outermost && *innermost == largest : is_outermost;
  }
  return stays;
}

}  // namespace

ShellCounts count_shells(const std::vector<std::shared_ptr<const MeshCells>>& parts, double cell_size) {
  std::size_t vertices = 0;
  for (const auto& part : parts) vertices += part->positions.size() / 3;
  DisjointSets sets(vertices);
  MeshJoiner joiner;
  const auto join = [&](const Triangle& t) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  };
  for (const auto& part : parts) joiner.for_each_corner(*part, by_triangle(join));
  std::uint32_t shell_count = 0;
  for (std::uint32_t v = 0; v < sets.size() && shell_count < 2; ++v) shell_count += sets.root(v) == v;
  // A closed mesh in one part is a body, and most are.
  if (shell_count < 2) return {.bodies = shell_count};
  const std::vector<std::uint32_t> shell_of = number_shells(sets, shell_count);
  std::vector<Shell> shells(shell_count);
  std::vector<float> positions;
  positions.reserve(3 * vertices);
  for (const auto& part : parts) positions.insert(positions.end(), part->positions.begin(), part->positions.end());
  MeshJoiner again;
  const auto add_up = [&](const Triangle& t) { add(t, positions, shells[shell_of[t[0]]]); };
  for (const auto& part : parts) again.for_each_corner(*part, by_triangle(add_up));
  return count(positions, shells, cell_size);
}

KeptShells keep_shells(const Mesh& mesh, const ShellFilter& filter, double cell_size) {
  const auto for_each_triangle = [&](const auto& take) {
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      take(Triangle{mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]});
    }
  };
  DisjointSets sets(mesh.positions.size() / 3);
  for_each_triangle([&](const Triangle& t) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  });
  std::uint32_t shell_count = 0;
  const std::vector<std::uint32_t> shell_of = number_shells(sets, shell_count);
  std::vector<Shell> shells(shell_count);
  for_each_triangle([&](const Triangle& t) { add(t, mesh.positions, shells[shell_of[t[0]]]); });
  if (shell_count < 2 || filter.keeps_all()) return {mesh, count(mesh.positions, shells, cell_size), {}};
  const std::vector<char> stays = choose(mesh, shell_of, shells, filter);

  KeptShells kept;
  std::vector<Shell> kept_shells;
  for (std::uint32_t s = 0; s < shell_count; ++s) {
    if (stays[s]) {
      kept_shells.push_back(shells[s]);
    } else {
      ++(shells[s].is_void() ? kept.dropped.voids : kept.dropped.bodies);
    }
  }
  kept.shells = count(mesh.positions, kept_shells, cell_size);
  kept.mesh.cells = mesh.cells;
  std::vector<std::uint32_t> numbers(shell_of.size(), kNoVertex);
  std::uint32_t vertices = 0;
  for (std::size_t v = 0; v < shell_of.size(); ++v) {
    if (!stays[shell_of[v]]) continue;
    numbers[v] = vertices++;
    const auto copy = [v](const std::vector<float>& from, std::vector<float>& to) {
      if (!from.empty()) to.insert(to.end(), from.begin() + 3 * v, from.begin() + 3 * v + 3);
    };
    copy(mesh.positions, kept.mesh.positions);
    copy(mesh.normals, kept.mesh.normals);
  }
  for (const std::uint32_t v : mesh.triangles) {
    if (numbers[v] != kNoVertex) kept.mesh.triangles.push_back(numbers[v]);
  }
  return kept;
}

}  // namespace isofield::engine
