#pragma once

#include <absl/status/status.h>

#include <optional>
#include <string>

#include "isofield/client.h"
#include "output_file.h"

namespace isofield {

enum class MeshFormat { kGlb, kObj, kPly, kStl };

// Returns the format that a file's extension names: .glb, .obj, .ply or .stl. Nothing: the extension is another one.
std::optional<MeshFormat> mesh_format(const std::string& path);

// Returns true if files of a format can hold a normal for each side of a crease.
bool names_creases(MeshFormat format);

// Says which normals a file has on creases. kSharp: one for each side, if the format can hold that (OBJ can; GLB needs
// a vertex for each). kSmooth: one for each vertex.
enum class CreaseShading { kSharp, kSmooth };

// The unit of length of a file. Its coordinates are those of the mesh times `scale`.
struct FileUnit {
  double scale = 1;
  std::string name;  // the unit of the file's coordinates; empty if the file should not state one
};

// Writes a mesh, with normals if it has them, and with those of Mesh::creases if creases should be sharp. `name`
// becomes the object's name if the format has one. Does not commit the file. OUT_OF_RANGE: the mesh is too large for a
// GLB or STL.
absl::Status write_mesh(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                        CreaseShading shading = CreaseShading::kSharp, const FileUnit& unit = {});

// These functions write the formats.
//  - GLB: the arrays keep the mesh's coordinates and the node has the scale, so that nothing is rounded. The format's
//    unit is the metre.
//  - OBJ: the vertices stay as they are, and the corners of triangles name their normals.
//  - PLY is binary little-endian and has one normal for each vertex, because its readers want to know which triangles
//    share vertices.
//  - STL is binary and has a normal for each triangle, computed from its corners.
// The last three have no place for a scale but the coordinates, and name the unit in their headers.
absl::Status write_glb(const Mesh& mesh, const std::string& name, double scale, OutputFile& file);
absl::Status write_obj(const Mesh& mesh, const std::string& name, CreaseShading shading, const std::string& unit,
                       OutputFile& file);
absl::Status write_ply(const Mesh& mesh, const std::string& unit, OutputFile& file);
absl::Status write_stl(const Mesh& mesh, const std::string& unit, OutputFile& file);

}  // namespace isofield
