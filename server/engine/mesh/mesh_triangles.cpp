#include "engine/mesh/mesh_triangles.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/session.h"

namespace isofield::engine {

using gpu::Buffer;

gpu::Commands::Bindings QuadCutter::with_quads(const gpu::Commands::Bindings& own) const {
  gpu::Commands::Bindings all = quads_;
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

absl::Status QuadCutter::cut(const Buffer& positions, const Buffer& kinds, bool is_smooth) {
  const std::uint32_t total = quad_count();
  cuts_.resize(total);
  ISOFIELD_ASSIGN_OR_RETURN(cuts_buffer_, Buffer::create(device_, std::size_t{4} * total, Buffer::Use::kDevice));
  ISOFIELD_ASSIGN_OR_RETURN(corners_, Buffer::create(device_, std::size_t{16} * total, Buffer::Use::kDevice));
  const auto most = static_cast<std::uint32_t>(device_.profile().slab_quads);
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel,
                            kernels_.get(is_smooth ? shaders::kMeshQuadsSmooth : shaders::kMeshQuads));
  for (std::uint32_t first = 0; first < total; first += most) {
    ISOFIELD_RETURN_IF_ERROR(check_(0.95));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    MeshConstants constants = constants_;
    constants.first = first;
    constants.count = std::min(most, total - first);
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel,
                                                         with_quads({{binding::mesh::kPositions, &positions},
                                                                     {binding::mesh_quads::kCuts, &cuts_buffer_},
                                                                     {binding::mesh_quads::kKinds, &kinds},
                                                                     {binding::mesh_quads::kCorners, &corners_}}),
                                                         constants, mesh_groups(constants.count)));
    if (first + constants.count == total) {
      ISOFIELD_RETURN_IF_ERROR(session.download(cuts_buffer_, std::span(cuts_)));
    }
    ISOFIELD_RETURN_IF_ERROR(session.run());
  }
  number_fans();
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
  ISOFIELD_ASSIGN_OR_RETURN(fan_starts_buffer_, session.upload(std::span(fan_starts_)));
  ISOFIELD_ASSIGN_OR_RETURN(cuts_buffer_, session.upload(std::span(cuts_)));
  return session.run();
}

void QuadCutter::number_fans() {
  fan_starts_.reserve(starts_.size());
  std::uint32_t fans = 0, quad = 0;
  for (const MeshStart& start : starts_) {
    for (; quad < start[1]; ++quad) {
      const std::uint32_t cut = cuts_[quad];
      cuts_[quad] = cut | fans << 2;
      fans += cut == kCutFan ? 1 : 0;
    }
    fan_starts_.push_back({fans, 0});
  }
}

absl::StatusOr<Buffer> QuadCutter::make(std::vector<std::uint32_t>& corners, std::vector<float>& positions) {
  const std::uint32_t total = quad_count();
  corners.resize(std::size_t{6} * (total + fans()));
  positions.resize(std::size_t{3} * fans());
  const auto most = static_cast<std::uint32_t>(device_.profile().slab_quads);
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(shaders::kMeshTriangles));
  ISOFIELD_ASSIGN_OR_RETURN(Buffer centres,
                            Buffer::create(device_, std::size_t{12} * std::max(fans(), 1u), Buffer::Use::kDevice));
  for (std::uint32_t first = 0; first < total; first += most) {
    ISOFIELD_RETURN_IF_ERROR(check_(0.96 + 0.03 * first / total));
    const std::uint32_t count = std::min(most, total - first);
    const std::size_t begin = std::size_t{6} * (first + fans_before(first));
    const std::size_t end = std::size_t{6} * (first + count + fans_before(first + count));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
    ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const triangles, session.lend_scratch(4 * (end - begin)));
    MeshConstants constants = constants_;
    constants.first = first;
    constants.count = count;
    ISOFIELD_RETURN_IF_ERROR(
        session.commands().dispatch(kernel,
                                    with_quads({{binding::mesh_triangles::kCorners, &corners_},
                                                {binding::mesh_triangles::kCuts, &cuts_buffer_},
                                                {binding::mesh_triangles::kTriangles, triangles},
                                                {binding::mesh_triangles::kCentres, &centres},
                                                {binding::mesh_triangles::kFanStarts, &fan_starts_buffer_}}),
                                    constants, mesh_groups(count)));
    ISOFIELD_RETURN_IF_ERROR(session.download(*triangles, std::span(corners).subspan(begin, end - begin)));
    if (first + count == total) {
      ISOFIELD_RETURN_IF_ERROR(session.download(centres, std::span(positions)));
    }
    ISOFIELD_RETURN_IF_ERROR(session.run());
  }
  return centres;
}

}  // namespace isofield::engine
