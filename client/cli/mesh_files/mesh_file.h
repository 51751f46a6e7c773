#pragma once

#include <absl/status/status.h>

#include <optional>
#include <string>

#include "isofield/client.h"
#include "output_file.h"

namespace isofield {

enum class MeshFormat { kGlb, kObj, kPly, kStl };

// By the extension: .glb, .obj, .ply or .stl.
std::optional<MeshFormat> mesh_format(const std::string& path);

// On creases: one for each side, where the format has room for that (GLB, by more vertices, and OBJ), or one a vertex.
enum class CreaseShading { kSharp, kSmooth };

// Writes a mesh, with normals where it has them. Coordinates go out as they are, in model units; `name` becomes the
// object's name where the format has one. Does not commit.
absl::Status write_mesh(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                        CreaseShading shading = CreaseShading::kSharp);

// The formats. OBJ's vertices stay as they are: corners of triangles name their normals. PLY, which is read for what is
// joined to what, has one normal a vertex. STL is binary and has a normal for each triangle, by its corners; PLY is
// binary little-endian.
absl::Status write_glb(const Mesh& mesh, const std::string& name, OutputFile& file);
absl::Status write_obj(const Mesh& mesh, const std::string& name, CreaseShading shading, OutputFile& file);
absl::Status write_ply(const Mesh& mesh, OutputFile& file);
absl::Status write_stl(const Mesh& mesh, OutputFile& file);

}  // namespace isofield
