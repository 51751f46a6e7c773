#include "engine/mesher.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/mesh_lattice.h"
#include "engine/session.h"
#include "engine/status_macros.h"
#include "engine/surface_cases.h"
#include "engine/tape_windows.h"

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
// Quads of one submission and one output buffer.
constexpr std::uint32_t kQuadSlab = 1u << 21;
constexpr std::uint32_t kLocalSize = 64;

// Mirrors shaders/lib/mesh_constants.glsl.
struct Constants {
  float origin[3];
  float cell;
  std::uint32_t cells[4];
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  float iso;
  std::uint32_t flags;  // 1: capped, 2: a signed field
};

using Pair = std::array<std::uint32_t, 2>;

std::uint32_t groups_of(std::uint64_t invocations) {
  return static_cast<std::uint32_t>((invocations + kLocalSize - 1) / kLocalSize);
}

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
    ISOFIELD_RETURN_IF_ERROR(place_vertices());
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
                  (request_.bounds ? 1u : 0u) | (is_signed ? 2u : 0u)};
    return absl::OkStatus();
  }

  absl::Status upload_bricks() {
    std::vector<std::array<std::uint32_t, 4>> packed;
    for (const SurfaceCase& c : surface_cases()) packed.push_back(c.packed());
    const std::vector<std::uint32_t> neighbours = brick_neighbours(list_.bricks);
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    tapes_.emplace(device_, scene_, std::move(list_.code));
    windows_.reserve(list_.bricks.size());
    for (Brick& b : list_.bricks) windows_.push_back(tapes_->add(b.tape_begin, b.tape_count));
    ISOFIELD_RETURN_IF_ERROR(tapes_->upload(session));
    ISOFIELD_ASSIGN_OR_RETURN(bricks_, session.upload(std::span(list_.bricks)));
    ISOFIELD_ASSIGN_OR_RETURN(neighbours_, session.upload(std::span(neighbours)));
    ISOFIELD_ASSIGN_OR_RETURN(surface_cases_, session.upload(std::span(packed)));
    ISOFIELD_ASSIGN_OR_RETURN(cases_, session.scratch(list_.bricks.size() * kCells));
    return session.run();
  }

  // Runs a kernel that follows tapes over (brick, place in its slab) pairs, which binding 5 lists in `keep`: by window,
  // bricks of a single leaf by the kernel that knows no operator, the others by the scene's.
  template <class Wanted>
  absl::Status run_bricks(Session& session, const shaders::Spirv& shader, std::uint32_t first, std::uint32_t count,
                          Wanted is_wanted, std::vector<Buffer>& keep, gpu::Commands::Bindings own) {
    struct Group {
      std::uint32_t window;
      bool is_single;
      auto operator<=>(const Group&) const = default;
    };
    std::map<Group, std::vector<Pair>> groups;
    for (std::uint32_t b = first; b < first + count; ++b) {
      if (is_wanted(b)) groups[{windows_[b], list_.bricks[b].tape_count == 1}].push_back({b, b - first});
    }
    if (groups.empty()) return absl::OkStatus();
    std::vector<Pair> jobs;
    for (const auto& [group, members] : groups) jobs.insert(jobs.end(), members.begin(), members.end());
    ISOFIELD_ASSIGN_OR_RETURN(Buffer job_buffer, session.upload(std::span(jobs)));
    own.push_back({5, &keep.emplace_back(std::move(job_buffer))});
    Constants constants = constants_;
    for (const auto& [group, members] : groups) {
      const KernelKind kind = group.is_single ? KernelKind::single_leaf(scene_.tape()) : KernelKind::of(scene_.tape());
      ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels_.get(shader, tapes_->kind(kind, group.window)));
      constants.count = static_cast<std::uint32_t>(members.size());
      ISOFIELD_RETURN_IF_ERROR(
          session.commands().dispatch(*kernel, tapes_->bindings(group.window, own), constants, constants.count));
      constants.first += constants.count;
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
      ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshSample, first, count,
                                          [](std::uint32_t) { return true; }, keep, {{4, &bricks_}, {6, &samples}}));
      session.commands().barrier();
      Constants constants = constants_;
      constants.first = first;
      constants.count = count;
      ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(*classify, {{4, &bricks_}, {5, &samples}, {6, &cases_}},
                                                           constants, groups_of(std::uint64_t{count} * kCells / 4)));
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
        constants, groups_of(total)));
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
        constants, groups_of(total)));
    return session.run();
  }

  absl::Status place_vertices() {
    const std::size_t floats = std::size_t{3} * starts_.back()[0];
    mesh_.positions.resize(floats);
    if (request_.with_normals) mesh_.normals.resize(floats);
    const auto has_vertices = [&](std::uint32_t b) { return starts_[b + 1][0] > starts_[b][0]; };
    Buffer normals;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      ISOFIELD_RETURN_IF_ERROR(check(0.65 + 0.3 * s / slabs_.size()));
      const Slab& slab = slabs_[s];
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      if (s == 0) {
        ISOFIELD_ASSIGN_OR_RETURN(positions_, session.scratch(4 * floats));
        if (request_.with_normals) {
          ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(4 * floats));
        }
      }
      std::vector<Buffer> keep;
      keep.reserve(4);
      ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshVertices, slab.first, slab.count, has_vertices, keep,
                                          {{4, &bricks_},
                                           {6, &slab.samples},
                                           {7, &surface_cases_},
                                           {8, &cells_},
                                           {9, &starts_buffer_},
                                           {10, &vertex_list_},
                                           {11, &positions_}}));
      if (request_.with_normals) {
        session.commands().barrier();
        ISOFIELD_RETURN_IF_ERROR(run_bricks(session, shaders::kMeshNormals, slab.first, slab.count, has_vertices, keep,
                                            {{4, &bricks_}, {6, &starts_buffer_}, {7, &positions_}, {8, &normals}}));
      }
      if (s + 1 == slabs_.size()) {
        ISOFIELD_RETURN_IF_ERROR(session.download(positions_, std::span(mesh_.positions)));
        if (request_.with_normals) {
          ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(mesh_.normals)));
        }
      }
      ISOFIELD_RETURN_IF_ERROR(session.run());
    }
    slabs_.clear();
    return absl::OkStatus();
  }

  absl::Status make_triangles() {
    const std::uint32_t total = starts_.back()[1];
    mesh_.triangles.resize(std::size_t{6} * total);
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels_.get(shaders::kMeshTriangles));
    for (std::uint32_t first = 0; first < total; first += kQuadSlab) {
      ISOFIELD_RETURN_IF_ERROR(check(0.95 + 0.05 * first / total));
      const std::uint32_t count = std::min(kQuadSlab, total - first);
      ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
      ISOFIELD_ASSIGN_OR_RETURN(const Buffer triangles, session.scratch(std::size_t{24} * count));
      Constants constants = constants_;
      constants.first = first;
      constants.count = count;
      ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(*kernel,
                                                           {{4, &bricks_},
                                                            {5, &surface_cases_},
                                                            {6, &cells_},
                                                            {7, &neighbours_},
                                                            {8, &starts_buffer_},
                                                            {9, &quad_list_},
                                                            {10, &positions_},
                                                            {11, &triangles}},
                                                           constants, groups_of(count)));
      ISOFIELD_RETURN_IF_ERROR(session.download(
          triangles, std::span(mesh_.triangles).subspan(std::size_t{6} * first, std::size_t{6} * count)));
      ISOFIELD_RETURN_IF_ERROR(session.run());
    }
    return check(1);
  }

  gpu::Device& device_;
  KernelCache& kernels_;
  const ResidentScene& scene_;
  const MeshRequest& request_;
  const MeshCallbacks& callbacks_;

  BrickList list_;  // its code has gone to tapes_, and the bricks' tapes begin in their windows
  std::optional<TapeWindows> tapes_;
  std::vector<std::uint32_t> windows_;  // of the bricks' tapes
  Constants constants_{};
  std::vector<Slab> slabs_;
  std::vector<Pair> starts_;  // first vertex and first quad of each brick, and the totals
  Buffer bricks_, neighbours_, surface_cases_, cases_, cells_, starts_buffer_, vertex_list_, quad_list_, positions_;
  Mesh mesh_;
};

}  // namespace

absl::StatusOr<Mesh> Mesher::mesh(const ResidentScene& scene, const MeshRequest& request,
                                  const MeshCallbacks& callbacks) {
  return Run(device_, kernels_, scene, request, callbacks).mesh();
}

}  // namespace isofield::engine
