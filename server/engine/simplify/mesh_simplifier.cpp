#include "engine/simplify/mesh_simplifier.h"

#include <absl/container/flat_hash_set.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/status_macros.h"
#include "engine/mesh/crease_wedges.h"
#include "engine/simplify/mesh_piece.h"
#include "engine/simplify/triangle_tree.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

// The length of a piece, in mean edges: meshoptimizer's float32 quadrics are exact enough there, and none takes long.
constexpr double kPieceEdges = 24;
// Pieces grow from pass to pass, since the triangles do, and shift, so that they lie across the borders before.
constexpr int kPasses = 4;
constexpr double kGrowth = 1.3, kShift = 0.37;
// The error that meshoptimizer is allowed, as a part of the bound: at first, and how much more in each pass. Its error
// is a mean over planes and starts from nothing in each pass.
constexpr double kFirstAsked = 0.5, kMoreAsked = 0.15;
// A pass that leaves more than this part of the triangles is the last one.
constexpr double kLittle = 0.98;
// A piece is tried kTries times, each time without the triangles that went wrong; then this is repeated up to kHalvings
// times, each time with half of the error that was allowed before.
constexpr int kTries = 4, kHalvings = 2;
// A triangle is checked at the middles of smaller ones, with edges of this length in edges of the mesh: an edge apart.
constexpr double kSampleEdges = 1.7;
// The cosine of the angle by which a triangle may turn from the triangles that it replaces.
constexpr double kFacing = 0.5;
// A triangle is flat if twice its area is at most this part of the square of its longest edge.
constexpr double kFlat = 1e-6;
constexpr std::uint32_t kNoNumber = std::numeric_limits<std::uint32_t>::max();

class Simplifier {
 public:
  Simplifier(const Mesh& mesh, double max_error, const MeshCallbacks& callbacks)
      : mesh_(mesh),
        max_error_(max_error),
        callbacks_(callbacks),
        facing_(mesh.positions.size() / 3),
        homes_(facing_.size()),
        is_frozen_(facing_.size()),
        seen_(facing_.size()) {}

  absl::StatusOr<Mesh> simplified() {
    ISOFIELD_RETURN_IF_ERROR(prepare());
    if (!(spacing_ > 0)) return mesh_;
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::size_t before = triangles_.size();
      ISOFIELD_RETURN_IF_ERROR(run(pass));
      if (static_cast<double>(triangles_.size()) > kLittle * static_cast<double>(before)) break;
    }
    return result();
  }

 private:
  absl::Status check() const {
    return callbacks_.cancelled && callbacks_.cancelled() ? absl::CancelledError("the request was cancelled")
                                                          : absl::OkStatus();
  }

  absl::Status prepare() {
    ISOFIELD_RETURN_IF_ERROR(check());
    original_.resize(mesh_.triangles.size() / 3);
    double edges = 0;
    for (std::uint32_t t = 0; t < original_.size(); ++t) {
      std::copy_n(&mesh_.triangles[3 * std::size_t{t}], 3, original_[t].begin());
      const dvec3 n = normal_of(mesh_.positions, original_[t]);
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t v = original_[t][i];
        facing_[v] = facing_[v] + n;
        homes_[v] = t;
        edges += length(at(v) - at(original_[t][(i + 1) % 3]));
      }
    }
    spacing_ = edges / static_cast<double>(mesh_.triangles.size());
    ISOFIELD_RETURN_IF_ERROR(check());
    tree_.emplace(mesh_.positions, original_);
    ISOFIELD_RETURN_IF_ERROR(check());
    wedges_ = crease_wedges(mesh_);
    triangles_ = wedges_.triangles;
    local_.assign(wedges_.vertices.size(), kNoNumber);
    return absl::OkStatus();
  }

  dvec3 at(std::uint32_t vertex) const { return position_of(mesh_.positions, vertex); }
  Triangle vertices_of(const Triangle& t) const {
    return {wedges_.vertices[t[0]], wedges_.vertices[t[1]], wedges_.vertices[t[2]]};
  }
  std::vector<Triangle> vertices_of(const std::vector<Triangle>& triangles) const {
    std::vector<Triangle> out;
    out.reserve(triangles.size());
    for (const Triangle& t : triangles) out.push_back(vertices_of(t));
    return out;
  }

  absl::Status run(int pass) {
    ISOFIELD_RETURN_IF_ERROR(check());
    const auto places = pieces(kPieceEdges * spacing_ * std::pow(kGrowth, pass), kShift * pass);
    list_guests();
    edges_.emplace(vertices_of(triangles_), facing_.size());
    asked_ = (kFirstAsked + kMoreAsked * pass) * max_error_;
    next_.clear();
    std::vector<std::uint32_t> piece;
    for (std::size_t i = 0; i < places.size(); ++i) {
      piece.push_back(places[i].second);
      if (i + 1 < places.size() && places[i + 1].first == places[i].first) continue;
      ISOFIELD_RETURN_IF_ERROR(check());
      if (!is_simplified(piece)) {
        for (const std::uint32_t t : piece) keep(t);
      }
      piece.clear();
      const double fraction = static_cast<double>(i + 1) / static_cast<double>(places.size());
      if (callbacks_.progress) callbacks_.progress((pass + fraction) / kPasses);
    }
    triangles_.swap(next_);
    return absl::OkStatus();
  }

  // Returns each triangle with the cube that its middle lies in, sorted by cube. The triangles of a cube are a piece.
  std::vector<std::pair<std::array<std::int64_t, 3>, std::uint32_t>> pieces(double size, double shift) const {
    std::vector<std::pair<std::array<std::int64_t, 3>, std::uint32_t>> places(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Triangle v = vertices_of(triangles_[t]);
      const dvec3 middle = (at(v[0]) + at(v[1]) + at(v[2])) * (1 / (3 * size));
      const auto cell = [shift](double x) { return static_cast<std::int64_t>(std::floor(x + shift)); };
      places[t] = {{cell(middle.z), cell(middle.y), cell(middle.x)}, t};
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  void list_guests() {
    starts_.assign(triangles_.size() + 1, 0);
    for (const std::uint32_t t : homes_) ++starts_[t + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    guests_.resize(homes_.size());
    std::vector<std::uint32_t> ends(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t v = 0; v < homes_.size(); ++v) guests_[ends[homes_[v]]++] = v;
  }

  bool is_simplified(const std::vector<std::uint32_t>& piece) {
    for (int halvings = 0; halvings <= kHalvings; ++halvings) {
      if (is_simplified(piece, std::ldexp(asked_, -halvings))) return true;
    }
    return false;
  }

  // Simplifies a piece, which is a list of triangle numbers. The triangles that take their place go to next_, and
  // homes_ is updated. Returns false, and changes neither, if the piece cannot be simplified.
  bool is_simplified(const std::vector<std::uint32_t>& piece, double asked) {
    for (const std::uint32_t t : piece) {
      for (const std::uint32_t v : vertices_of(triangles_[t])) is_frozen_[v] = false;
    }
    std::vector<std::uint32_t> movable;
    std::vector<Triangle> before, after;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      movable.clear();
      before.clear();
      for (const std::uint32_t t : piece) {
        const Triangle v = vertices_of(triangles_[t]);
        if (is_frozen_[v[0]] || is_frozen_[v[1]] || is_frozen_[v[2]]) continue;
        movable.push_back(t);
        before.push_back(triangles_[t]);
      }
      after = collapsed(before, asked);
      if (after.size() == before.size()) return false;
      const std::vector<Triangle> after_vertices = vertices_of(after);
      const Fit fits = fit(vertices_of(before), after_vertices, *edges_);
      std::vector<std::uint32_t> wrong = fits.misfits;
      if (wrong.empty() && !fits.has_same_handles) return false;
      std::vector<std::pair<std::uint32_t, std::uint32_t>> moved;
      if (wrong.empty()) wrong = faults(movable, after_vertices, moved);
      if (wrong.empty()) {
        for (const std::uint64_t edge : fits.chords) edges_->insert(edge);
        accept(piece, movable, after, moved);
        return true;
      }
      for (const std::uint32_t v : wrong) is_frozen_[v] = true;
    }
    return false;
  }

  // Returns the triangles that meshoptimizer makes of these by collapsing edges; it uses only vertices that they have.
  std::vector<Triangle> collapsed(const std::vector<Triangle>& triangles, double asked) {
    if (triangles.empty()) return {};
    std::vector<std::uint32_t> used, indices, result;
    std::vector<float> positions;
    const dvec3 origin = at(wedges_.vertices[triangles[0][0]]);
    for (const Triangle& t : triangles) {
      for (const std::uint32_t wedge : t) {
        if (local_[wedge] == kNoNumber) {
          local_[wedge] = static_cast<std::uint32_t>(used.size());
          used.push_back(wedge);
          const dvec3 p = at(wedges_.vertices[wedge]) - origin;
          for (const double x : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(x));
        }
        indices.push_back(local_[wedge]);
      }
    }
    for (const std::uint32_t wedge : used) local_[wedge] = kNoNumber;
    const float scale = meshopt_simplifyScale(positions.data(), used.size(), 3 * sizeof(float));
    result.resize(indices.size());
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), positions.data(), used.size(),
                                   3 * sizeof(float), 0, static_cast<float>(asked / scale),
                                   meshopt_SimplifyLockBorder));
    std::vector<Triangle> out(result.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i) out[i / 3][i % 3] = result[i];
    turn_flat(positions, out);
    for (Triangle& t : out) t = {used[t[0]], used[t[1]], used[t[2]]};
    return out;
  }

  // Returns the vertices at which new triangles are flat, face away or are too far off, or old vertices are too far
  // off. `moved` receives the vertices that are gone, each with the number of a new triangle near it.
  std::vector<std::uint32_t> faults(const std::vector<std::uint32_t>& before, const std::vector<Triangle>& after,
                                    std::vector<std::pair<std::uint32_t, std::uint32_t>>& moved) {
    std::vector<std::uint32_t> found;
    absl::flat_hash_set<Triangle> old;
    for (const std::uint32_t t : before) old.insert(vertices_of(triangles_[t]));
    for (const Triangle& t : after) {
      if (!old.contains(t) && !is_good(t)) found.insert(found.end(), t.begin(), t.end());
    }
    ++now_;
    for (const Triangle& t : after) {
      for (const std::uint32_t v : t) seen_[v] = now_;
    }
    TriangleTree tree(mesh_.positions, after);
    for (const std::uint32_t home : before) {
      for (std::uint32_t i = starts_[home]; i < starts_[home + 1]; ++i) {
        const std::uint32_t v = guests_[i];
        if (seen_[v] == now_) continue;
        if (const auto triangle = tree.find(at(v), facing_[v], 0, max_error_)) {
          moved.push_back({v, *triangle});
        } else {
          const Triangle t = vertices_of(triangles_[home]);
          found.insert(found.end(), t.begin(), t.end());
        }
      }
    }
    return found;
  }

  bool is_good(const Triangle& t) {
    const dvec3 a = at(t[0]), b = at(t[1]) - a, c = at(t[2]) - a, n = cross(b, c);
    const double longest = std::max({length(b), length(c), length(c - b)});
    if (length(n) <= kFlat * longest * longest) return false;
    const int parts = static_cast<int>(std::ceil(longest / (kSampleEdges * spacing_)));
    const auto is_near = [&](double u, double v) {
      return tree_->find(a + b * (u / parts) + c * (v / parts), n, kFacing, max_error_).has_value();
    };
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        if (!is_near(i + 1.0 / 3, j + 1.0 / 3)) return false;
        if (i + j + 1 < parts && !is_near(i + 2.0 / 3, j + 2.0 / 3)) return false;
      }
    }
    return true;
  }

  void put(const Triangle& t) {
    for (const std::uint32_t v : vertices_of(t)) homes_[v] = static_cast<std::uint32_t>(next_.size());
    next_.push_back(t);
  }
  void keep(std::uint32_t t) {
    for (std::uint32_t i = starts_[t]; i < starts_[t + 1]; ++i) {
      homes_[guests_[i]] = static_cast<std::uint32_t>(next_.size());
    }
    put(triangles_[t]);
  }
  void accept(const std::vector<std::uint32_t>& piece, const std::vector<std::uint32_t>& movable,
              const std::vector<Triangle>& after, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& moved) {
    std::size_t next_movable = 0;
    for (const std::uint32_t t : piece) {
      if (next_movable < movable.size() && movable[next_movable] == t) {
        ++next_movable;
      } else {
        keep(t);
      }
    }
    const auto first = static_cast<std::uint32_t>(next_.size());
    for (const Triangle& t : after) put(t);
    for (const auto& [vertex, triangle] : moved) homes_[vertex] = first + triangle;
  }

  Mesh result() const {
    Mesh out{.cells = mesh_.cells};
    std::vector<std::uint32_t> numbers(facing_.size(), kNoNumber);
    for (const Triangle& t : triangles_) {
      for (const std::uint32_t v : vertices_of(t)) numbers[v] = 0;
    }
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < numbers.size(); ++v) {
      if (numbers[v] == kNoNumber) continue;
      numbers[v] = count++;
      const auto copy = [v](const std::vector<float>& from, std::vector<float>& to) {
        if (!from.empty()) to.insert(to.end(), &from[3 * std::size_t{v}], &from[3 * std::size_t{v}] + 3);
      };
      copy(mesh_.positions, out.positions);
      copy(mesh_.normals, out.normals);
    }
    out.triangles.reserve(3 * triangles_.size());
    for (const Triangle& t : triangles_) {
      for (const std::uint32_t v : vertices_of(t)) out.triangles.push_back(numbers[v]);
    }
    return out;
  }

  const Mesh& mesh_;
  const double max_error_;
  const MeshCallbacks& callbacks_;
  std::vector<Triangle> original_;    // the triangles of mesh_, by vertex numbers
  std::optional<TriangleTree> tree_;  // finds original triangles
  double spacing_ = 0;                // mean length of the original edges, model units
  std::vector<dvec3> facing_;         // the sum of the normals around each vertex
  CreaseWedges wedges_;
  std::vector<Triangle> triangles_;  // the triangles before the present pass, by wedge numbers
  std::vector<Triangle> next_;       // the triangles that the pass has made so far
  // The home of each vertex: a triangle that it is a corner of or, once the vertex is gone, one within max_error of it.
  // The number is one of triangles_, or one of next_ once the pass has been there.
  std::vector<std::uint32_t> homes_;
  // The vertices whose home is triangle t: guests_[starts_[t]] up to guests_[starts_[t + 1]].
  std::vector<std::uint32_t> starts_, guests_;
  std::optional<MeshEdges> edges_;
  std::vector<bool> is_frozen_;  // by vertex; the triangles at a frozen one stay as they are
  double asked_ = 0;
  std::vector<std::uint32_t> seen_;  // the value of now_ when a vertex was last seen
  std::uint32_t now_ = 0;
  std::vector<std::uint32_t> local_;  // the numbers that wedges have for meshoptimizer
};

}  // namespace

absl::StatusOr<Mesh> simplify(const Mesh& mesh, double max_error, const MeshCallbacks& callbacks) {
  if (mesh.triangles.empty()) return mesh;
  return Simplifier(mesh, max_error, callbacks).simplified();
}

}  // namespace isofield::engine
