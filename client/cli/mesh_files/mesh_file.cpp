#include "mesh_files/mesh_file.h"

#include <absl/strings/match.h>

#include "mesh_files/crease_normals.h"

namespace isofield {

std::optional<MeshFormat> mesh_format(const std::string& path) {
  if (absl::EndsWithIgnoreCase(path, ".glb")) return MeshFormat::kGlb;
  if (absl::EndsWithIgnoreCase(path, ".obj")) return MeshFormat::kObj;
  if (absl::EndsWithIgnoreCase(path, ".ply")) return MeshFormat::kPly;
  if (absl::EndsWithIgnoreCase(path, ".stl")) return MeshFormat::kStl;
  return std::nullopt;
}

absl::Status write_mesh(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                        CreaseShading shading) {
  switch (format) {
    case MeshFormat::kGlb:
      return write_glb(shading == CreaseShading::kSharp ? split_at_creases(mesh) : mesh, name, file);
    case MeshFormat::kObj:
      return write_obj(mesh, name, shading, file);
    case MeshFormat::kPly:
      return write_ply(mesh, file);
    case MeshFormat::kStl:
      return write_stl(mesh, file);
  }
  return absl::InternalError("unknown mesh format");
}

}  // namespace isofield
