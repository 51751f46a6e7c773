#include <absl/strings/str_cat.h>

#include <array>
#include <cstring>

#include "mesh_files/mesh_file.h"

namespace isofield {

absl::Status write_ply(const Mesh& mesh, const std::string& unit, OutputFile& file) {
  const bool normals = !mesh.normals.empty();
  absl::Status status = file.write(
      absl::StrCat("ply\nformat binary_little_endian 1.0\ncomment isofield\n",
                   unit.empty() ? "" : absl::StrCat("comment unit ", unit, "\n"), "element vertex ",
                   mesh.vertex_count(), "\nproperty float x\nproperty float y\nproperty float z\n",
                   normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "", "element face ",
                   mesh.triangle_count(), "\nproperty list uchar uint vertex_indices\nend_header\n"));
  for (std::size_t i = 0; status.ok() && i < mesh.positions.size(); i += 3) {
    status = file.write(&mesh.positions[i], 3 * sizeof(float));
    if (normals) status.Update(file.write(&mesh.normals[i], 3 * sizeof(float)));
  }
  for (std::size_t i = 0; status.ok() && i < mesh.triangles.size(); i += 3) {
    std::array<char, 1 + 3 * sizeof(std::uint32_t)> face;
    face[0] = 3;
    std::memcpy(&face[1], &mesh.triangles[i], 3 * sizeof(std::uint32_t));
    status = file.write(face.data(), face.size());
  }
  return status;
}

}  // namespace isofield
