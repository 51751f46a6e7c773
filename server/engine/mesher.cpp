#include "engine/mesher.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/mesh_constants.h"
#include "engine/mesh_creases.h"
#include "engine/mesh_lattice.h"
#include "engine/mesh_triangles.h"
#include "engine/session.h"
#include "engine/status_macros.h"
#include "engine/surface_cases.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;
using blobtree::BrickList;
using blobtree::Lattice;
using gpu::Buffer;

constexpr std::uint32_t kCells = blobtree::kCellsPerBrick;
constexpr std::uint32_t kEdgeCorners = blobtree::kBrickCells + 1;
constexpr std::uint32_t kCorners = kEdgeCorners * kEdgeCorners * kEdgeCorners;
// Bricks of one submission, and instructions of their tapes: what a cancelled request still waits for, and others with
// it.
constexpr std::uint32_t kSlab = 16'384;
constexpr std::uint64_t kSlabInstructions = 1u << 18;
using Constants = MeshConstants;
using Pair = MeshStart;

// The state of one request on its way through the passes.
class Run {
 public:
  Run(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene, const MeshRequest& request,
      const MeshCallbacks& callbacks)
      : device_(device), kernels_(kernels), scene_(scene), request_(request), callbacks_(callbacks) {}

  absl::StatusOr<Mesh> mesh() {
    if (scene_.tape().support.empty()) return Mesh{};
    ISOFIELD_RETURN_IF_ERROR(find_bricks());
    if (list_.bricks.empty()) return Mesh{};
    mesh_.cells = std::uint64_t{list_.bricks.size()} * kCells;
    ISOFIELD_RETURN_IF_ERROR(upload_bricks());
    ISOFIELD_RETURN_IF_ERROR(sample());
    ISOFIELD_RETURN_IF_ERROR(connect());
    if (starts_.back()[0] == 0) return std::move(mesh_);
    ISOFIELD_RETURN_IF_ERROR(list_elements());
    ISOFIELD_RETURN_IF_ERROR(find_crossings());
    ISOFIELD_RETURN_IF_ERROR(place_vertices());
    ISOFIELD_RETURN_IF_ERROR(settle_vertices());
    ISOFIELD_RETURN_IF_ERROR(make_triangles());
    return std::move(mesh_);
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

  absl::Status find_bricks() {
    ISOFIELD_RETURN_IF_ERROR(check(0));
    // One binding holds a word for every cell.
    const std::uint64_t bound = device_.description().max_buffer_bytes / (4 * kCells);
    const std::uint64_t most = std::min<std::uint64_t>({request_.max_cells / kCells, bound, 1u << 24});
    ISOFIELD_ASSIGN_OR_RETURN(SurfaceBricks found, surface_bricks(scene_.tape(), request_, most, callbacks_.cancelled));
    const Lattice& lattice = found.lattice;
    list_ = std::move(found.list);
    const bool is_signed = scene_.tape().law == operators::Law::kSigned;
    constants_ = {{static_cast<float>(lattice.origin.x), static_cast<float>(lattice.origin.y),
                   static_cast<float>(lattice.origin.z)},
                  static_cast<float>(request_.cell_size),
                  {lattice.cells[0], lattice.cells[1], lattice.cells[2], 0},
                  0,
                  0,
                  static_cast<float>(is_signed ? -request_.iso : request_.iso),
                  (request_.bounds ? 1u : 0u) | (is_signed ? 2u : 0u),
                  static_cast<float>(request_.tolerance),
                  static_cast<std::uint32_t>(list_.bricks.size())};
    return absl::OkStatus();
  }

  absl::Status upload_bricks() {
    std::vector<std::array<std::uint32_t, 4>> packed;
    for (const SurfaceCase& c : surface_cases()) packed.push_back(c.packed());
    brick_neighbours_ = brick_neighbours(list_.bricks);
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(bricks_, session.upload(std::span(list_.bricks)));
    ISOFIELD_ASSIGN_OR_RETURN(code_, session.upload(std::span(list_.code)));
    ISOFIELD_ASSIGN_OR_RETURN(neighbours_, session.upload(std::span(brick_neighbours_)));
    ISOFIELD_ASSIGN_OR_RETURN(surface_cases_, session.upload(std::span(packed)));
    ISOFIELD_ASSIGN_OR_RETURN(cases_, session.scratch(list_.bricks.size() * kCells));
    return session.run();
  }

  // Runs a kernel that follows tapes over (brick, place in its slab) pairs: bricks of a single leaf by the kernel that
  // knows no operator, the others by the scene's.
  template <class Wanted>
  absl::Status run_bricks(
      Session& session, const shaders::Spirv& shader, std::uint32_t first, std::uint32_t count, Wanted is_wanted,
      std::vector<Buffer>& keep,
      const std::function<absl::Status(const gpu::Pipeline&, const Buffer& jobs, std::uint32_t)>& dispatch) {
    for (const bool single : {true, false}) {
      std::vector<Pair> jobs;
      for (std::uint32_t b = first; b < first + count; ++b) {
        if ((list_.bricks[b].tape_count == 1) == single && is_wanted(b)) jobs.push_back({b, b - first});
      }
      if (jobs.empty()) continue;
      ISOFIELD_ASSIGN_OR_RETURN(
          const gpu::Pipeline* kernel,
          kernels_.get(shader, single ? KernelKind::single_leaf(scene_.tape()) : KernelKind::of(scene_.tape())));
      ISOFIELD_ASSIGN_OR_RETURN(Buffer job_buffer, session.upload(std::span(jobs)));
      keep.push_back(std::move(job_buffer));
      ISOFIELD_RETURN_IF_ERROR(dispatch(*kernel, keep.back(), static_cast<std::uint32_t>(jobs.size())));
    }
    return absl::OkStatus();
  }

  // How many bricks from `first` on make a slab; at least one.
  std::uint32_t slab_from(std::uint32_t first) const {
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    std::uint64_t instructions = 0;
    std::uint32_t end = first;
    while (end < total && end - first < kSlab && (end == first || instructions < kSlabInstructions)) {
      instructions += list_.bricks[end++].tape_count;
    }
    return end - first;
  }

  absl::Status sample() {
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* classify, kernels_.get(shaders::kMeshClassify));
    for (std::uint32_t first = 0, count = 0; first < total; first += count) {
      ISOFIELD_RETURN_IF_ERROR(check(0.1 + 0.5 * first / total));
      count = slab_from(first);
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      ISOFIELD_ASSIGN_OR_RETURN(Buffer samples, session.scratch(std::size_t{4} * kCorners * count));
      std::vector<Buffer> keep;
      keep.reserve(2);
      ISOFIELD_RETURN_IF_ERROR(run_bricks(
          session, shaders::kMeshSample, first, count, [](std::uint32_t) { return true; }, keep,
          [&](const gpu::Pipeline& kernel, const Buffer& jobs, std::uint32_t groups) {
            return session.commands().dispatch(
                kernel, scene_.bindings(code_, {{4, &bricks_}, {5, &jobs}, {6, &samples}}), constants_, groups);
          }));
      session.commands().barrier();
      Constants constants = constants_;
      constants.first = first;
      constants.count = count;
      ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(*classify, {{4, &bricks_}, {5, &samples}, {6, &cases_}},
                                                           constants, mesh_groups(std::uint64_t{count} * kCells / 4)));
      ISOFIELD_RETURN_IF_ERROR(session.run());
      slabs_.push_back({first, count, std::move(samples)});
    }
    return absl::OkStatus();
  }

  absl::Status connect() {
    ISOFIELD_RETURN_IF_ERROR(check(0.6));
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    std::vector<Pair> counts(total);
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels_.get(shaders::kMeshConnect));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(cells_, session.scratch(std::size_t{4} * kCells * total));
    ISOFIELD_ASSIGN_OR_RETURN(const Buffer count_buffer, session.scratch(sizeof(Pair) * total));
    Constants constants = constants_;
    constants.count = total;
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        *kernel,
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
    const std::uint64_t most = device_.description().max_buffer_bytes / 12;
    if (vertices > most || quads > most) {
      return absl::ResourceExhaustedError(absl::StrCat("cell_size = ", request_.cell_size, " makes ", vertices,
                                                       " vertices; this device holds ", most,
                                                       "; ask for a larger cell size, or a part by its bounds"));
    }
    return absl::OkStatus();
  }

  absl::Status list_elements() {
    ISOFIELD_RETURN_IF_ERROR(check(0.65));
    const auto total = static_cast<std::uint32_t>(list_.bricks.size());
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels_.get(shaders::kMeshList));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(starts_buffer_, session.upload(std::span(starts_)));
    ISOFIELD_ASSIGN_OR_RETURN(vertex_list_, session.scratch(std::size_t{4} * starts_.back()[0]));
    ISOFIELD_ASSIGN_OR_RETURN(quad_list_, session.scratch(std::size_t{8} * starts_.back()[1]));
    Constants constants = constants_;
    constants.count = total;
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        *kernel,
        {{4, &bricks_}, {5, &surface_cases_}, {6, &cells_}, {7, &starts_buffer_}, {8, &vertex_list_}, {9, &quad_list_}},
        constants, mesh_groups(total)));
    return session.run();
  }

  // Crossings of all slabs before any vertex: a vertex takes them from its neighbours' bricks too.
  absl::Status find_crossings() {
    kinds_ = brick_kinds(scene_.tape(), list_, brick_neighbours_);
    ISOFIELD_ASSIGN_OR_RETURN(crossings_,
                              Buffer::create(device_, std::size_t{12} * starts_.back()[1], Buffer::Use::kDevice));
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_RETURN_IF_ERROR(check(0.65 + 0.1 * s / slabs_.size()));
      ISOFIELD_RETURN_IF_ERROR(find_crossings(slabs_[s], [&](std::uint32_t b) {
        return (kinds_[b] & kKnowsCrossings) != 0 && starts_[b + 1][1] > starts_[b][1];
      }));
    }
    return absl::OkStatus();
  }

  template <class Wanted>
  absl::Status find_crossings(const Slab& slab, Wanted is_wanted) {
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    std::vector<Buffer> keep;
    keep.reserve(2);
    ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshCrossings, slab.first, slab.count, is_wanted, keep,
                                        [&](const gpu::Pipeline& kernel, const Buffer& jobs, std::uint32_t groups) {
                                          return session.commands().dispatch(
                                              kernel,
                                              scene_.bindings(code_, {{4, &bricks_},
                                                                      {5, &jobs},
                                                                      {6, &slab.samples},
                                                                      {8, &starts_buffer_},
                                                                      {9, &quad_list_},
                                                                      {10, &crossings_}}),
                                              constants_, groups);
                                        }));
    return session.run();
  }

  absl::Status place_vertices() {
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels_.get(shaders::kMeshPlace));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(positions_, session.scratch(std::size_t{12} * starts_.back()[0]));
    ISOFIELD_ASSIGN_OR_RETURN(kinds_buffer_, session.upload(std::span(kinds_)));
    for (const Slab& slab : slabs_) {
      Constants constants = constants_;
      constants.first = slab.first;
      ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(*kernel,
                                                           {{4, &bricks_},
                                                            {5, &surface_cases_},
                                                            {6, &cells_},
                                                            {7, &neighbours_},
                                                            {8, &starts_buffer_},
                                                            {9, &vertex_list_},
                                                            {10, &crossings_},
                                                            {11, &positions_},
                                                            {12, &kinds_buffer_},
                                                            {13, &slab.samples}},
                                                           constants, slab.count));
    }
    ISOFIELD_RETURN_IF_ERROR(session.download(kinds_buffer_, std::span(kinds_)));
    return session.run();
  }

  // Onto the surface: vertices on creases along all sides of these, then all that are not there yet.
  absl::Status settle_vertices() {
    const std::size_t floats = std::size_t{3} * starts_.back()[0];
    mesh_.positions.resize(floats);
    if (request_.with_normals) mesh_.normals.resize(floats);
    const auto has_vertices = [&](std::uint32_t b) { return starts_[b + 1][0] > starts_[b][0]; };
    const auto has_creases = [&](std::uint32_t b) { return (kinds_[b] & kHasCreases) != 0; };
    Buffer normals;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_RETURN_IF_ERROR(check(0.75 + 0.2 * s / slabs_.size()));
      const Slab& slab = slabs_[s];
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      if (s == 0 && request_.with_normals) {
        ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(4 * floats));
      }
      std::vector<Buffer> keep;
      keep.reserve(6);
      ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshCreases, slab.first, slab.count, has_creases, keep,
                                          [&](const gpu::Pipeline& kernel, const Buffer& jobs, std::uint32_t groups) {
                                            return session.commands().dispatch(
                                                kernel,
                                                scene_.bindings(code_, {{4, &bricks_},
                                                                        {5, &jobs},
                                                                        {6, &cells_},
                                                                        {7, &neighbours_},
                                                                        {8, &starts_buffer_},
                                                                        {9, &vertex_list_},
                                                                        {10, &crossings_},
                                                                        {11, &positions_}}),
                                                constants_, groups);
                                          }));
      session.commands().barrier();
      ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshVertices, slab.first, slab.count, has_vertices, keep,
                                          [&](const gpu::Pipeline& kernel, const Buffer& jobs, std::uint32_t groups) {
                                            return session.commands().dispatch(
                                                kernel,
                                                scene_.bindings(code_, {{4, &bricks_},
                                                                        {5, &jobs},
                                                                        {6, &cells_},
                                                                        {7, &surface_cases_},
                                                                        {8, &starts_buffer_},
                                                                        {9, &vertex_list_},
                                                                        {11, &positions_}}),
                                                constants_, groups);
                                          }));
      if (request_.with_normals) {
        session.commands().barrier();
        ISOFIELD_RETURN_IF_ERROR(find_normals(session, slab, has_vertices, starts_buffer_, positions_, normals, keep));
      }
      if (s + 1 == slabs_.size()) {
        ISOFIELD_RETURN_IF_ERROR(session.download(positions_, std::span(mesh_.positions)));
        if (request_.with_normals) {
          ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(mesh_.normals)));
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
    return run_bricks(
        session, shaders::kMeshNormals, slab.first, slab.count, is_wanted, keep,
        [&](const gpu::Pipeline& kernel, const Buffer& jobs, std::uint32_t groups) {
          return session.commands().dispatch(
              kernel, scene_.bindings(code_, {{4, &bricks_}, {5, &jobs}, {6, &starts}, {7, &positions}, {8, &normals}}),
              constants_, groups);
        });
  }

  absl::Status make_triangles() {
    const QuadCutter::Check checked = [this](double fraction) { return check(fraction); };
    QuadCutter cutter(device_, kernels_, constants_,
                      {{4, &bricks_},
                       {5, &surface_cases_},
                       {6, &cells_},
                       {7, &neighbours_},
                       {8, &starts_buffer_},
                       {9, &quad_list_},
                       {10, &crossings_}},
                      starts_, checked);
    ISOFIELD_RETURN_IF_ERROR(cutter.cut(positions_, kinds_buffer_));
    const auto is_unknown = [&](std::uint32_t b) { return (kinds_[b] & kKnowsCrossings) == 0 && cutter.has_fans(b); };
    for (std::size_t s = 0; s < slabs_.size() && cutter.fans() > 0; ++s) {
      ISOFIELD_RETURN_IF_ERROR(find_crossings(slabs_[s], is_unknown));
    }
    ISOFIELD_ASSIGN_OR_RETURN(const Buffer centres, cutter.make(mesh_));
    if (cutter.fans() > 0 && request_.with_normals) ISOFIELD_RETURN_IF_ERROR(find_fan_normals(cutter, centres));
    return check(1);
  }

  absl::Status find_fan_normals(const QuadCutter& cutter, const Buffer& centres) {
    const auto has_fans = [&](std::uint32_t b) { return cutter.has_fans(b); };
    const std::size_t floats = std::size_t{3} * cutter.fans();
    mesh_.normals.resize(mesh_.normals.size() + floats);
    Buffer starts, normals;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      if (s == 0) {
        ISOFIELD_ASSIGN_OR_RETURN(starts, session.upload(std::span(cutter.fan_starts())));
        ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(4 * floats));
      }
      std::vector<Buffer> keep;
      keep.reserve(2);
      ISOFIELD_RETURN_IF_ERROR(find_normals(session, slabs_[s], has_fans, starts, centres, normals, keep));
      if (s + 1 == slabs_.size()) {
        ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(mesh_.normals).last(floats)));
      }
      ISOFIELD_RETURN_IF_ERROR(session.run());
    }
    return absl::OkStatus();
  }

  gpu::Device& device_;
  KernelCache& kernels_;
  const ResidentScene& scene_;
  const MeshRequest& request_;
  const MeshCallbacks& callbacks_;

  BrickList list_;
  Constants constants_{};
  std::vector<Slab> slabs_;
  std::vector<Pair> starts_;  // first vertex and first quad of each brick, and the totals
  std::vector<std::uint32_t> brick_neighbours_, kinds_;
  Buffer bricks_, code_, neighbours_, surface_cases_, cases_, cells_, starts_buffer_, vertex_list_, quad_list_,
      crossings_, kinds_buffer_, positions_;
  Mesh mesh_;
};

}  // namespace

absl::StatusOr<Mesh> Mesher::mesh(const ResidentScene& scene, const MeshRequest& request,
                                  const MeshCallbacks& callbacks) {
  return Run(device_, kernels_, scene, request, callbacks).mesh();
}

}  // namespace isofield::engine
