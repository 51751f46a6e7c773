#include "engine/mesh/part_on_device.h"

#include <array>
#include <span>
#include <utility>

#include "base/status_macros.h"
#include "engine/mesh/mesh_creases.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_rounding.h"
#include "engine/mesh/mesh_settle.h"
#include "engine/mesh/surface_cases.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

MeshConstants constants_of(const ResidentScene& scene, const MeshRequest& request, const blobtree::Lattice& lattice) {
  const bool is_signed = scene.tape().law == operators::Law::kSigned;
  MeshConstants constants{{static_cast<float>(lattice.origin.x), static_cast<float>(lattice.origin.y),
                           static_cast<float>(lattice.origin.z)},
                          static_cast<float>(request.cell_size),
                          {lattice.cells[0], lattice.cells[1], lattice.cells[2], 0},
                          0,
                          0,
                          static_cast<float>(is_signed ? -request.iso : request.iso),
                          (request.bounds ? kIsCapped : 0u) | (is_signed ? kIsSigned : 0u),
                          static_cast<float>(request.tolerance)};
  set_rounding(mesh_rounding(scene.tape(), lattice, request.iso), constants);
  return constants;
}

}  // namespace

PartOnDevice::PartOnDevice(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                           const MeshRequest& request, PartBricks part, const MeshCallbacks& callbacks)
    : device(device),
      kernels(kernels, callbacks.compiling),
      scene(scene),
      request(request),
      callbacks(callbacks),
      constants(constants_of(scene, request, part.lattice)),
      list(std::move(part.list)),
      owned(part.owned),
      placed(part.placed),
      crossed(part.crossed),
      neighbours(brick_neighbours(list.bricks)),
      kinds(brick_kinds(scene.tape(), list, neighbours)),
      tapes(device, this->kernels, scene, list) {}

absl::Status PartOnDevice::upload() {
  std::vector<std::array<std::uint32_t, 4>> packed;
  for (const SurfaceCase& c : engine::surface_cases()) packed.push_back(c.packed());
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_RETURN_IF_ERROR(tapes.upload(session));
  ISOFIELD_ASSIGN_OR_RETURN(bricks, session.upload(std::span(list.bricks)));
  ISOFIELD_ASSIGN_OR_RETURN(neighbours_buffer, session.upload(std::span(neighbours)));
  ISOFIELD_ASSIGN_OR_RETURN(surface_cases, session.upload(std::span(packed)));
  return session.run();
}

absl::Status PartOnDevice::check(double fraction) const {
  if (callbacks.cancelled && callbacks.cancelled()) return absl::CancelledError("the request was cancelled");
  if (callbacks.progress) callbacks.progress(fraction);
  return absl::OkStatus();
}

}  // namespace isofield::engine
