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

// Whether files of a format have room for a normal for each side of a crease.
bool names_creases(MeshFormat format);

// On creases: one for each side, where the format has room for that (GLB, by more vertices, and OBJ), or one a vertex.
enum class CreaseShading { kSharp, kSmooth };

// The lengths of a file: its coordinates are the mesh's times `scale`.
struct FileUnit {
  double scale = 1;
  std::string name;  // of the unit that they are in then; empty: the file does not state one
};

// Writes a mesh, with normals where it has them, and with those of Mesh::creases where these are to be sharp; `name`
// becomes the object's name where the format has one. Does not commit.
absl::Status write_mesh(const Mesh& mesh, MeshFormat format, const std::string& name, OutputFile& file,
                        CreaseShading shading = CreaseShading::kSharp, const FileUnit& unit = {});

// The formats. OBJ's vertices stay as they are: corners of triangles name their normals. PLY, which is read for what is
// joined to what, has one normal a vertex. STL is binary and has a normal for each triangle, by its corners; PLY is
// binary little-endian. GLB's arrays keep the mesh's coordinates and its node has the scale, so that nothing is
// rounded; the unit of the format is the metre. The others have no place for a scale but the coordinates, and name the
// unit in their headers.
absl::Status write_glb(const Mesh& mesh, const std::string& name, double scale, OutputFile& file);
absl::Status write_obj(const Mesh& mesh, const std::string& name, CreaseShading shading, const std::string& unit,
                       OutputFile& file);
absl::Status write_ply(const Mesh& mesh, const std::string& unit, OutputFile& file);
absl::Status write_stl(const Mesh& mesh, const std::string& unit, OutputFile& file);

}  // namespace isofield
