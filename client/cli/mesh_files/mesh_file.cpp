#include "mesh_files/mesh_file.h"

#include <absl/strings/match.h>

#include <algorithm>

#include "mesh_files/crease_normals.h"

namespace isofield {

std::optional<MeshFormat> mesh_format(const std::string& path) {
  if (absl::EndsWithIgnoreCase(path, ".glb")) return MeshFormat::kGlb;
  if (absl::EndsWithIgnoreCase(path, ".obj")) return MeshFormat::kObj;
  if (absl::EndsWithIgnoreCase(path, ".ply")) return MeshFormat::kPly;
  if (absl::EndsWithIgnoreCase(path, ".stl")) return MeshFormat::kStl;
  return std::nullopt;
}

bool names_creases(MeshFormat format) {
  return format == MeshFormat::kGlb || format == MeshFormat::kObj;
}

namespace {

absl::Status write_scaled(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                          CreaseShading shading, std::string unit) {
  // The unit becomes part of a line of the header, so it must not break that line.
  std::replace_if(
      unit.begin(), unit.end(), [](unsigned char c) { return c < ' '; }, ' ');
  switch (format) {
    case MeshFormat::kObj:
      return write_obj(mesh, name, shading, unit, file);
    case MeshFormat::kPly:
      return write_ply(mesh, unit, file);
    case MeshFormat::kStl:
      return write_stl(mesh, unit, file);
    default:
      return absl::InternalError("unknown mesh format");
  }
}

}  // namespace

absl::Status write_mesh(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                        CreaseShading shading, const FileUnit& unit) {
  if (format == MeshFormat::kGlb) {
    return write_glb(shading == CreaseShading::kSharp ? split_at_creases(mesh) : mesh, name, unit.scale, file);
  }
  if (unit.scale == 1) return write_scaled(mesh, format, name, file, shading, unit.name);
  Mesh scaled = mesh;
  for (float& x : scaled.positions) x = static_cast<float>(x * unit.scale);
  return write_scaled(scaled, format, name, file, shading, unit.name);
}

}  // namespace isofield
