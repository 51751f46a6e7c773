#include "engine/mesh/mesh_part.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "base/status_macros.h"
#include "engine/dealing.h"
#include "engine/mesh/brick_tapes.h"
#include "engine/mesh/mesh_constants.h"
#include "engine/mesh/mesh_creases.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_rounding.h"
#include "engine/mesh/mesh_samples.h"
#include "engine/mesh/mesh_settle.h"
#include "engine/mesh/mesh_triangles.h"
#include "engine/mesh/surface_cases.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;
using blobtree::BrickList;
using blobtree::Lattice;
using gpu::Buffer;

constexpr std::uint32_t kCells = blobtree::kCellsPerBrick;
constexpr std::uint32_t kEdgeCorners = blobtree::kBrickCells + 1;
constexpr std::uint32_t kCorners = kEdgeCorners * kEdgeCorners * kEdgeCorners;
using Constants = MeshConstants;
using Pair = MeshStart;

// The state of one part on its way through the passes.
class Run {
 public:
  Run(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene, const MeshRequest& request,
      PartBricks part, const MeshCallbacks& callbacks)
      : device_(device),
        kernels_(kernels, callbacks.compiling),
        scene_(scene),
        request_(request),
        callbacks_(callbacks),
        list_(std::move(part.list)),
        owned_(part.owned),
        placed_(part.placed),
        crossed_(part.crossed) {
    const Lattice& lattice = part.lattice;
    const bool is_signed = scene.tape().law == operators::Law::kSigned;
    constants_ = {{static_cast<float>(lattice.origin.x), static_cast<float>(lattice.origin.y),
                   static_cast<float>(lattice.origin.z)},
                  static_cast<float>(request.cell_size),
                  {lattice.cells[0], lattice.cells[1], lattice.cells[2], 0},
                  0,
                  0,
                  static_cast<float>(is_signed ? -request.iso : request.iso),
                  (request.bounds ? 1u : 0u) | (is_signed ? 2u : 0u),
                  static_cast<float>(request.tolerance)};
    set_rounding(mesh_rounding(scene.tape(), lattice, request.iso), constants_);
  }

  absl::StatusOr<PartMesh> mesh() {
    ISOFIELD_RETURN_IF_ERROR(upload_bricks());
    ISOFIELD_RETURN_IF_ERROR(sample());
    ISOFIELD_RETURN_IF_ERROR(connect());
    PartMesh mesh;
    mesh.cells.cells = std::uint64_t{owned_} * kCells;
    if (starts_[placed_][0] == 0 && starts_[owned_][1] == 0) return mesh;
    ISOFIELD_RETURN_IF_ERROR(list_elements());
    ISOFIELD_RETURN_IF_ERROR(find_crossings());
    ISOFIELD_RETURN_IF_ERROR(place_vertices());
    ISOFIELD_RETURN_IF_ERROR(settle_vertices());
    ISOFIELD_RETURN_IF_ERROR(make_triangles(mesh.cells));
    list_vertices_beside(mesh.beside);
    return mesh;
  }

 private:
  struct Slab {
    std::uint32_t first, count;
    Buffer samples;
  };

  absl::Status check(double fraction) {
    if (callbacks_.cancelled && callbacks_.cancelled()) return absl::CancelledError("the request was cancelled");
    if (callbacks_.progress) callbacks_.progress(fraction);
    return absl::OkStatus();
  }

  absl::Status upload_bricks() {
    std::vector<std::array<std::uint32_t, 4>> packed;
    for (const SurfaceCase& c : surface_cases()) packed.push_back(c.packed());
    brick_neighbours_ = brick_neighbours(list_.bricks);
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    kinds_ = brick_kinds(scene_.tape(), list_, brick_neighbours_);
    tapes_.emplace(device_, kernels_, scene_, list_);
    ISOFIELD_RETURN_IF_ERROR(tapes_->upload(session));
    ISOFIELD_ASSIGN_OR_RETURN(bricks_, session.upload(std::span(list_.bricks)));
    ISOFIELD_ASSIGN_OR_RETURN(neighbours_, session.upload(std::span(brick_neighbours_)));
    ISOFIELD_ASSIGN_OR_RETURN(surface_cases_, session.upload(std::span(packed)));
    ISOFIELD_ASSIGN_OR_RETURN(cases_, session.scratch(list_.bricks.size() * kCells));
    return session.run();
  }

  // How many bricks from `first` on make a slab; at least one.
  std::uint32_t slab_from(std::uint32_t first) const {
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    const gpu::DeviceProfile& most = device_.profile();
    std::uint64_t instructions = 0;
    std::uint32_t end = first;
    while (end < total && end - first < most.slab_bricks && (end == first || instructions < most.slab_instructions)) {
      instructions += list_.bricks[end++].tape_count;
    }
    return end - first;
  }

  absl::Status sample() {
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline share, kernels_.get(shaders::kMeshShare));
    for (std::uint32_t first = 0, count = 0; first < total; first += count) {
      ISOFIELD_RETURN_IF_ERROR(check(0.1 + 0.5 * first / total));
      count = slab_from(first);
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      ISOFIELD_ASSIGN_OR_RETURN(Buffer samples, session.scratch(std::size_t{4} * kCorners * count));
      std::vector<Buffer> keep;
      keep.reserve(2);
      const SampleParts parts = sample_parts(brick_neighbours_, first, count);
      BrickTapes::Jobs jobs;
      for (std::uint32_t b = first; b < first + count; ++b) {
        std::vector<BrickTapes::Job>& group = jobs[tapes_->group_of(b)];
        for (std::uint32_t left = parts.evaluated[b - first]; left != 0; left &= left - 1) {
          group.push_back({b, (b - first) * kSampleParts + static_cast<std::uint32_t>(std::countr_zero(left))});
        }
      }
      Constants constants = constants_;
      constants.shift = 0;
      ISOFIELD_RETURN_IF_ERROR(tapes_->run(session, shaders::kMeshSample, constants, jobs, kSamplePartsPerGroup,
                                           {{4, &bricks_}, {6, &samples}}, keep));
      session.commands().barrier();
      constants.count = static_cast<std::uint32_t>(parts.taken_over.size());
      if (constants.count > 0) {
        ISOFIELD_ASSIGN_OR_RETURN(Buffer copies, session.upload(std::span(parts.taken_over)));
        ISOFIELD_RETURN_IF_ERROR(
            session.commands().dispatch(share, {{5, &keep.emplace_back(std::move(copies))}, {6, &samples}}, constants,
                                        (constants.count + kSamplePartsPerGroup - 1) / kSamplePartsPerGroup));
        session.commands().barrier();
      }
      const Slab& slab = slabs_.emplace_back(first, count, std::move(samples));
      std::vector<std::uint32_t> is_near(count);
      ISOFIELD_ASSIGN_OR_RETURN(const Buffer near_bricks, session.upload(std::span(is_near)));
      constants = constants_;
      constants.first = first;
      constants.count = count;
      const SampledSlab sampled{first, slab.samples, cases_};
      ISOFIELD_RETURN_IF_ERROR(classify(session, kernels_, constants, sampled, near_bricks, near_bricks));
      ISOFIELD_RETURN_IF_ERROR(session.download(near_bricks, std::span(is_near)));
      ISOFIELD_RETURN_IF_ERROR(session.run());
      ISOFIELD_RETURN_IF_ERROR(settle_samples(device_, kernels_, *tapes_, constants_, bricks_, sampled, is_near));
    }
    return absl::OkStatus();
  }

  absl::Status connect() {
    ISOFIELD_RETURN_IF_ERROR(check(0.6));
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    std::vector<Pair> counts(total);
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(shaders::kMeshConnect));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(cells_, session.scratch(std::size_t{4} * kCells * total));
    ISOFIELD_ASSIGN_OR_RETURN(const Buffer count_buffer, session.scratch(sizeof(Pair) * total));
    Constants constants = constants_;
    constants.count = total;
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        kernel,
        {{4, &bricks_}, {5, &surface_cases_}, {6, &cases_}, {7, &neighbours_}, {8, &cells_}, {9, &count_buffer}},
        constants, mesh_groups(total)));
    ISOFIELD_RETURN_IF_ERROR(session.download(count_buffer, std::span(counts)));
    ISOFIELD_RETURN_IF_ERROR(session.run());
    starts_.assign(1, {0, 0});
    starts_.reserve(total + 1);
    std::uint64_t vertices = 0, quads = 0;
    for (const Pair& c : counts) {
      vertices += c[0];
      quads += c[1];
      starts_.push_back({static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(quads)});
    }
    // Of 12 bytes a vertex, and 16 a quad (QuadCutter).
    const std::uint64_t most = device_.description().max_buffer_bytes;
    if (12 * vertices > most || 16 * quads > most) {
      return absl::ResourceExhaustedError(absl::StrCat("cell_size = ", request_.cell_size, " makes ", vertices,
                                                       " vertices; this device holds ", most / 16,
                                                       "; ask for a larger cell size, or a part by its bounds"));
    }
    return absl::OkStatus();
  }

  absl::Status list_elements() {
    ISOFIELD_RETURN_IF_ERROR(check(0.65));
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(shaders::kMeshList));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(starts_buffer_, session.upload(std::span(starts_)));
    ISOFIELD_ASSIGN_OR_RETURN(vertex_list_, session.scratch(std::size_t{4} * starts_.back()[0]));
    ISOFIELD_ASSIGN_OR_RETURN(quad_list_, session.scratch(std::size_t{8} * starts_.back()[1]));
    Constants constants = constants_;
    constants.count = total;
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        kernel,
        {{4, &bricks_}, {5, &surface_cases_}, {6, &cells_}, {7, &starts_buffer_}, {8, &vertex_list_}, {9, &quad_list_}},
        constants, mesh_groups(total)));
    return session.run();
  }

  // Crossings of all slabs before any vertex: a vertex takes them from its neighbours' bricks too.
  absl::Status find_crossings() {
    ISOFIELD_ASSIGN_OR_RETURN(crossings_,
                              Buffer::create(device_, std::size_t{12} * starts_.back()[1], Buffer::Use::kDevice));
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_RETURN_IF_ERROR(check(0.65 + 0.1 * s / slabs_.size()));
      ISOFIELD_RETURN_IF_ERROR(find_crossings(slabs_[s], [&](std::uint32_t b) {
        return b < crossed_ && (kinds_[b] & kKnowsCrossings) != 0 && starts_[b + 1][1] > starts_[b][1];
      }));
    }
    return absl::OkStatus();
  }

  template <class Wanted>
  absl::Status find_crossings(const Slab& slab, Wanted is_wanted) {
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    std::vector<Buffer> keep;
    keep.reserve(2);
    ISOFIELD_RETURN_IF_ERROR(tapes_->run_each(
        session, kernels_.of(shaders::kMeshCrossings), constants_, slab.first, slab.count, is_wanted,
        {{4, &bricks_}, {6, &slab.samples}, {8, &starts_buffer_}, {9, &quad_list_}, {10, &crossings_}}, keep));
    return session.run();
  }

  bool has_vertices(std::uint32_t brick) const { return starts_[brick + 1][0] > starts_[brick][0]; }

  absl::Status place_vertices() {
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(positions_, session.scratch(std::size_t{12} * starts_.back()[0]));
    ISOFIELD_ASSIGN_OR_RETURN(kinds_buffer_, session.upload(std::span(kinds_)));
    std::vector<Buffer> keep;
    keep.reserve(2 * slabs_.size());
    for (const Slab& slab : slabs_) {
      ISOFIELD_RETURN_IF_ERROR(place_vertices(session, slab, shaders::kMeshPlace, kMayCrease, keep));
      ISOFIELD_RETURN_IF_ERROR(place_vertices(session, slab, shaders::kMeshPlaceSmooth, 0, keep));
    }
    ISOFIELD_RETURN_IF_ERROR(session.download(kinds_buffer_, std::span(kinds_)));
    return session.run();
  }

  // Of those of the slab's bricks of which kMayCrease is as told.
  absl::Status place_vertices(Session& session, const Slab& slab, const shaders::InRounds& shader,
                              std::uint32_t may_crease, std::vector<Buffer>& keep) {
    std::vector<std::uint32_t> bricks;
    for (std::uint32_t b = slab.first; b < std::min(slab.first + slab.count, placed_); ++b) {
      if (has_vertices(b) && (kinds_[b] & kMayCrease) == may_crease) bricks.push_back(b);
    }
    if (bricks.empty()) return absl::OkStatus();
    deal(bricks, 0, bricks.size(), device_.profile().dispatch_runs);
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(kernels_.of(shader)));
    ISOFIELD_ASSIGN_OR_RETURN(Buffer placed, session.upload(std::span(bricks)));
    Constants constants = constants_;
    constants.first = slab.first;
    return session.commands().dispatch(kernel,
                                       {{4, &bricks_},
                                        {5, &surface_cases_},
                                        {6, &cells_},
                                        {7, &neighbours_},
                                        {8, &starts_buffer_},
                                        {9, &vertex_list_},
                                        {10, &crossings_},
                                        {11, &positions_},
                                        {12, &kinds_buffer_},
                                        {13, &slab.samples},
                                        {14, &keep.emplace_back(std::move(placed))}},
                                       constants, static_cast<std::uint32_t>(bricks.size()));
  }

  // Onto the surface: vertices on creases along all sides of these, then all that are not there yet.
  absl::Status settle_vertices() {
    vertex_positions_.resize(std::size_t{3} * starts_[placed_][0]);
    if (request_.with_normals) vertex_normals_.resize(std::size_t{3} * starts_[owned_][0]);
    const auto has_placed_vertices = [&](std::uint32_t b) { return b < placed_ && has_vertices(b); };
    const auto has_own_vertices = [&](std::uint32_t b) { return b < owned_ && has_vertices(b); };
    const auto has_creases = [&](std::uint32_t b) { return b < placed_ && (kinds_[b] & kHasCreases) != 0; };
    Buffer normals;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_RETURN_IF_ERROR(check(0.75 + 0.2 * s / slabs_.size()));
      const Slab& slab = slabs_[s];
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      if (s == 0 && request_.with_normals) {
        ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(4 * vertex_normals_.size()));
      }
      std::vector<Buffer> keep;
      keep.reserve(6);
      ISOFIELD_RETURN_IF_ERROR(tapes_->run_each(session, kernels_.of(shaders::kMeshCreases), constants_, slab.first,
                                                slab.count, has_creases,
                                                {{4, &bricks_},
                                                 {6, &cells_},
                                                 {7, &neighbours_},
                                                 {8, &starts_buffer_},
                                                 {9, &vertex_list_},
                                                 {10, &crossings_},
                                                 {11, &positions_}},
                                                keep));
      session.commands().barrier();
      ISOFIELD_RETURN_IF_ERROR(tapes_->run_each(session, kernels_.of(shaders::kMeshVertices), constants_, slab.first,
                                                slab.count, has_placed_vertices,
                                                {{4, &bricks_},
                                                 {6, &cells_},
                                                 {7, &surface_cases_},
                                                 {8, &starts_buffer_},
                                                 {9, &vertex_list_},
                                                 {11, &positions_}},
                                                keep));
      if (request_.with_normals) {
        session.commands().barrier();
        ISOFIELD_RETURN_IF_ERROR(
            find_normals(session, slab, has_own_vertices, starts_buffer_, positions_, normals, keep));
      }
      if (s + 1 == slabs_.size()) {
        ISOFIELD_RETURN_IF_ERROR(session.download(positions_, std::span(vertex_positions_)));
        if (request_.with_normals) {
          ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(vertex_normals_)));
        }
      }
      ISOFIELD_RETURN_IF_ERROR(session.run());
    }
    return absl::OkStatus();
  }

  // Of the positions of a slab's bricks, which start where `starts` says.
  template <class Wanted>
  absl::Status find_normals(Session& session, const Slab& slab, Wanted is_wanted, const Buffer& starts,
                            const Buffer& positions, const Buffer& normals, std::vector<Buffer>& keep) {
    return tapes_->run_each(session, kernels_.of(shaders::kMeshNormals), constants_, slab.first, slab.count, is_wanted,
                            {{4, &bricks_}, {6, &starts}, {7, &positions}, {8, &normals}}, keep);
  }

  absl::Status make_triangles(MeshCells& cells) {
    const QuadCutter::Check checked = [this](double fraction) { return check(fraction); };
    QuadCutter cutter(device_, kernels_, constants_,
                      {{4, &bricks_},
                       {5, &surface_cases_},
                       {6, &cells_},
                       {7, &neighbours_},
                       {8, &starts_buffer_},
                       {9, &quad_list_},
                       {10, &crossings_}},
                      std::span(starts_).first(owned_ + 1), checked);
    const bool is_smooth =
        std::none_of(kinds_.begin(), kinds_.end(), [](std::uint32_t kind) { return (kind & kMayCrease) != 0; });
    ISOFIELD_RETURN_IF_ERROR(cutter.cut(positions_, kinds_buffer_, is_smooth));
    const auto is_unknown = [&](std::uint32_t b) {
      return b < owned_ && (kinds_[b] & kKnowsCrossings) == 0 && cutter.has_fans(b);
    };
    for (std::size_t s = 0; s < slabs_.size() && cutter.fans() > 0; ++s) {
      ISOFIELD_RETURN_IF_ERROR(find_crossings(slabs_[s], is_unknown));
    }
    std::vector<float> centres, centre_normals;
    ISOFIELD_ASSIGN_OR_RETURN(const Buffer centre_buffer, cutter.make(cells.corners, centres));
    if (cutter.fans() > 0 && request_.with_normals) {
      ISOFIELD_ASSIGN_OR_RETURN(centre_normals, find_fan_normals(cutter, centre_buffer));
    }
    ISOFIELD_RETURN_IF_ERROR(check(1));
    // Brick by brick: the vertices of its cells, then those amid its fans.
    const auto append = [](std::vector<float>& to, const std::vector<float>& from, std::uint32_t begin,
                           std::uint32_t end) {
      if (!from.empty())
        to.insert(to.end(), from.begin() + 3 * std::size_t{begin}, from.begin() + 3 * std::size_t{end});
    };
    cells.positions.reserve(3 * std::size_t{starts_[owned_][0]} + centres.size());
    cells.normals.reserve(vertex_normals_.size() + centre_normals.size());
    for (std::uint32_t b = 0; b < owned_; ++b) {
      const MeshStart begin = starts_[b], end = starts_[b + 1];
      const std::uint32_t fan = cutter.fan_starts()[b][0], fan_end = cutter.fan_starts()[b + 1][0];
      const std::uint32_t vertices = end[0] - begin[0] + fan_end - fan;
      const std::uint32_t triangles = 2 * (end[1] - begin[1] + fan_end - fan);
      if (vertices == 0 && triangles == 0) continue;
      const Brick& at = list_.bricks[b];
      cells.bricks.push_back({at.x, at.y, at.z, vertices, triangles});
      append(cells.positions, vertex_positions_, begin[0], end[0]);
      append(cells.positions, centres, fan, fan_end);
      append(cells.normals, vertex_normals_, begin[0], end[0]);
      append(cells.normals, centre_normals, fan, fan_end);
    }
    return absl::OkStatus();
  }

  void list_vertices_beside(MeshCells& beside) const {
    for (std::uint32_t b = owned_; b < placed_; ++b) {
      const std::uint32_t vertices = starts_[b + 1][0] - starts_[b][0];
      const Brick& at = list_.bricks[b];
      if (vertices > 0) beside.bricks.push_back({at.x, at.y, at.z, vertices, 0});
    }
    beside.positions.assign(vertex_positions_.begin() + 3 * std::size_t{starts_[owned_][0]}, vertex_positions_.end());
  }

  absl::StatusOr<std::vector<float>> find_fan_normals(const QuadCutter& cutter, const Buffer& centres) {
    const auto has_fans = [&](std::uint32_t b) { return b < owned_ && cutter.has_fans(b); };
    std::vector<float> found(std::size_t{3} * cutter.fans());
    Buffer starts, normals;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      if (s == 0) {
        ISOFIELD_ASSIGN_OR_RETURN(starts, session.upload(std::span(cutter.fan_starts())));
        ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(4 * found.size()));
      }
      std::vector<Buffer> keep;
      keep.reserve(2);
      ISOFIELD_RETURN_IF_ERROR(find_normals(session, slabs_[s], has_fans, starts, centres, normals, keep));
      if (s + 1 == slabs_.size()) ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(found)));
      ISOFIELD_RETURN_IF_ERROR(session.run());
    }
    return found;
  }

  gpu::Device& device_;
  const Kernels kernels_;
  const ResidentScene& scene_;
  const MeshRequest& request_;
  const MeshCallbacks& callbacks_;

  BrickList list_;  // its code has gone to tapes_, and the bricks' tapes begin in their windows
  const std::uint32_t owned_, placed_, crossed_;  // as of PartBricks
  std::optional<BrickTapes> tapes_;
  Constants constants_{};
  std::vector<Slab> slabs_;
  std::vector<Pair> starts_;  // first vertex and first quad of each brick, and the totals
  std::vector<std::uint32_t> brick_neighbours_, kinds_;
  Buffer bricks_, neighbours_, surface_cases_, cases_, cells_, starts_buffer_, vertex_list_, quad_list_, crossings_,
      kinds_buffer_, positions_;
  std::vector<float> vertex_positions_, vertex_normals_;
};

}  // namespace

absl::StatusOr<PartMesh> mesh_part(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                                   const MeshRequest& request, PartBricks part, const MeshCallbacks& callbacks) {
  return Run(device, kernels, scene, request, std::move(part), callbacks).mesh();
}

}  // namespace isofield::engine
