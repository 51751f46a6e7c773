#include "rpc/mesh_writer.h"

#include <span>
#include <utility>

#include "base/status_macros.h"
#include "engine/mesh/crease_normals.h"
#include "rpc/answer_limit.h"
#include "rpc/handler.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

using Writer = grpc::ServerWriter<v1::MeshResponse>;

// Writes rows of numbers in several messages. Each has a part of them as the array `field` of its field `part`.
template <class T, class Part>
absl::Status write_rows(Writer& writer, std::span<const T> rows, std::size_t columns, Part* (v1::MeshResponse::*part)(),
                        v1::Tensor* (Part::*field)()) {
  return in_parts(rows, columns, [&](std::span<const T> some) {
    v1::MeshResponse response;
    set_rows(some, columns, *((response.*part)()->*field)());
    return send(writer, response);
  });
}

absl::Status write_arrays(Writer& writer, const std::vector<float>& positions, const std::vector<float>& normals,
                          std::span<const std::uint32_t> triangles) {
  const auto part = &v1::MeshResponse::mutable_part;
  ISOFIELD_RETURN_IF_ERROR(write_rows(writer, std::span(positions), 3, part, &v1::MeshPart::mutable_positions));
  ISOFIELD_RETURN_IF_ERROR(write_rows(writer, std::span(normals), 3, part, &v1::MeshPart::mutable_normals));
  return write_rows(writer, triangles, 3, part, &v1::MeshPart::mutable_triangles);
}

}  // namespace

absl::Status MeshWriter::write(const engine::MeshCells& cells) {
  if (!with_creases_) {
    const std::vector<std::uint32_t> triangles = joiner_.number(cells);
    return write_arrays(writer_, cells.positions, cells.normals, std::span(triangles));
  }
  const std::size_t before = whole_.triangles.size();
  joiner_.append(cells, whole_);
  return write_arrays(writer_, cells.positions, cells.normals, std::span(whole_.triangles).subspan(before));
}

absl::Status MeshWriter::write(engine::Mesh mesh) {
  whole_ = std::move(mesh);
  return write_arrays(writer_, whole_.positions, whole_.normals, std::span(whole_.triangles));
}

absl::Status MeshWriter::write_creases() {
  if (!with_creases_) return absl::OkStatus();
  const engine::CreaseNormals creases = engine::crease_normals(whole_);
  const auto part = &v1::MeshResponse::mutable_creases;
  const std::span<const std::uint32_t> vertices(creases.vertices), corners(creases.corners);
  ISOFIELD_RETURN_IF_ERROR(write_rows(writer_, vertices, 1, part, &v1::MeshCreases::mutable_vertices));
  ISOFIELD_RETURN_IF_ERROR(write_rows(writer_, std::span(creases.normals), 3, part, &v1::MeshCreases::mutable_normals));
  return write_rows(writer_, corners, 2, part, &v1::MeshCreases::mutable_corners);
}

}  // namespace isofield::rpc
