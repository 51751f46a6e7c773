#include "mesh_files/mesh_file.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "isofield/scene_file.h"
#include "mesh_files/crease_normals.h"
#include "support/cube_grid.h"
#include "test_support.h"

namespace isofield {
namespace {

std::string written(const Mesh& mesh, MeshFormat format, const FileUnit& unit = {},
                    const std::string& name = "a \"torus\"") {
  const TemporaryDirectory directory;
  const std::string path = directory.path("mesh");
  auto file = OutputFile::create(path);
  EXPECT_TRUE(file.ok()) << file.status();
  EXPECT_TRUE(write_mesh(mesh, format, name, **file, CreaseShading::kSharp, unit).ok());
  EXPECT_TRUE((*file)->commit().ok());
  return *read_file(path);
}

template <typename T>
std::vector<T> array_of(const tinygltf::Model& model, int accessor_index) {
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  EXPECT_EQ(view.byteOffset % 4, 0u);
  std::vector<T> out(view.byteLength / sizeof(T));
  std::memcpy(out.data(), &model.buffers[0].data.at(view.byteOffset), view.byteLength);
  return out;
}

TEST(MeshFile, FormatsByExtension) {
  EXPECT_EQ(mesh_format("a.GLB"), MeshFormat::kGlb);
  EXPECT_EQ(mesh_format("a.b/c.stl"), MeshFormat::kStl);
  EXPECT_FALSE(mesh_format("glb"));
}

// The format's unit is the metre, so the node is scaled, and the arrays keep the mesh's own numbers.
TEST(MeshFile, AGlbIsScaledByItsNode) {
  const Mesh mesh = torus_mesh(20, 10, 30000.0f, 100.0f);
  const auto model_of = [&](double scale) {
    const std::string glb = written(mesh, MeshFormat::kGlb, {scale, "m"});
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &error, &warning,
                                                          reinterpret_cast<const unsigned char*>(glb.data()),
                                                          static_cast<unsigned>(glb.size())))
        << error;
    return model;
  };
  const tinygltf::Model model = model_of(8e-9);
  EXPECT_EQ(model.nodes.at(0).scale, std::vector<double>(3, 8e-9));
  EXPECT_EQ(array_of<float>(model, model.meshes.at(0).primitives.at(0).attributes.at("POSITION")), mesh.positions);
  EXPECT_TRUE(model_of(1).nodes.at(0).scale.empty());
}

TEST(MeshFile, OtherFormatsAreScaledByTheirCoordinatesAndNameTheUnit) {
  const Mesh mesh = torus_mesh(20, 10, 2.0f, 1.0f);
  Mesh scaled = mesh;
  for (float& x : scaled.positions) x *= 1000;
  for (const MeshFormat format : {MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kStl}) {
    EXPECT_EQ(written(mesh, format, {1000, ""}), written(scaled, format));
    const std::string named = written(mesh, format, {1000, "8 nm"});
    EXPECT_NE(named, written(scaled, format));
    EXPECT_TRUE(absl::StrContains(named.substr(0, 120), "8 nm"));
  }
  EXPECT_TRUE(absl::StartsWith(written(mesh, MeshFormat::kObj, {1, "um"}), "# isofield\n# unit um\no "));
  EXPECT_TRUE(absl::StrContains(written(mesh, MeshFormat::kPly, {1, "um"}), "\ncomment unit um\n"));
  EXPECT_TRUE(absl::StartsWith(written(mesh, MeshFormat::kStl, {1, "um"}), std::string("isofield UNITS=um\0", 18)));
  // The unit that a scene states stays within its line, and within STL's header.
  const std::string long_unit(200, 'x');
  EXPECT_EQ(written(mesh, MeshFormat::kStl, {1, long_unit}).size(), written(mesh, MeshFormat::kStl).size());
  EXPECT_TRUE(
      absl::StrContains(written(mesh, MeshFormat::kPly, {1, "a\nend_header\nb"}), "\ncomment unit a end_header b\n"));
}

TEST(MeshFile, GlbReadsBack) {
  const Mesh mesh = torus_mesh(20, 10, 30000.0f, 100.0f);
  const std::string glb = written(mesh, MeshFormat::kGlb);
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()), static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  EXPECT_EQ(glb.size() % 4, 0u);
  ASSERT_EQ(model.meshes.size(), 1u);
  const auto& primitive = model.meshes[0].primitives.at(0);
  EXPECT_EQ(array_of<float>(model, primitive.attributes.at("POSITION")), mesh.positions);
  EXPECT_EQ(array_of<float>(model, primitive.attributes.at("NORMAL")), mesh.normals);
  EXPECT_EQ(array_of<std::uint32_t>(model, primitive.indices), mesh.triangles);
  const auto& bounds = model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))];
  EXPECT_EQ(bounds.count, 200u);
  EXPECT_EQ(bounds.maxValues.at(0), 30100);
  EXPECT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.scenes.at(0).nodes.size(), 1u);
}

// Returns the axis, 0 to 2, to which a triangle of a cube is at right angles.
std::size_t axis_of(const Mesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t c, std::size_t axis) {
    return mesh.positions[3 * std::size_t{mesh.triangles[3 * triangle + c]} + axis];
  };
  std::size_t axis = 0;
  while (at(0, axis) != at(1, axis) || at(0, axis) != at(2, axis)) ++axis;
  return axis;
}

// Makes a cube. A vertex on an edge has the normal of one of its sides, as a field's gradient has, and a wedge for each
// side.
Mesh cube_mesh(int n) {
  const test_support::CubeGrid grid = test_support::cube_grid(n);
  Mesh mesh;
  mesh.triangles = grid.triangles;
  for (const auto& place : grid.places) {
    for (const double x : place) mesh.positions.push_back(static_cast<float>(x));
  }
  for (const auto& side : grid.sides) {
    for (const double x : side) mesh.normals.push_back(static_cast<float>(x));
  }
  std::map<std::uint32_t, std::map<std::size_t, std::uint32_t>> wedges;  // by vertex and axis
  for (std::uint32_t c = 0; c < mesh.triangles.size(); ++c) {
    const std::uint32_t vertex = mesh.triangles[c];
    const auto& place = grid.places[vertex];
    if (std::count_if(place.begin(), place.end(), [](double x) { return std::abs(x) == 1; }) == 1) continue;
    const std::size_t axis = axis_of(mesh, c / 3);
    const auto [wedge, is_new] =
        wedges[vertex].try_emplace(axis, static_cast<std::uint32_t>(mesh.creases.vertices.size()));
    if (is_new) {
      mesh.creases.vertices.push_back(vertex);
      for (std::size_t a = 0; a < 3; ++a) {
        mesh.creases.normals.push_back(a == axis ? static_cast<float>(place[axis]) : 0);
      }
    }
    const auto& of_vertex = mesh.creases.vertices;
    const auto first = std::find(of_vertex.begin(), of_vertex.end(), vertex) - of_vertex.begin();
    if (wedge->second != first) mesh.creases.corners.insert(mesh.creases.corners.end(), {c, wedge->second});
  }
  return mesh;
}

// Checks that the normal of each corner of a triangle is the triangle's, within a degree.
void expect_flat_sides(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles,
                       const std::vector<float>& normals, const std::vector<std::uint32_t>& corners) {
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const auto at = [&](std::size_t c, int a) { return positions[3 * std::size_t{triangles[t + c]} + a]; };
    for (int axis = 0; axis < 3; ++axis) {
      if (at(0, axis) != at(1, axis) || at(0, axis) != at(2, axis)) continue;
      for (std::size_t c = t; c < t + 3; ++c) {
        EXPECT_GE(at(0, axis) * normals[3 * std::size_t{corners[c]} + axis], std::cos(M_PI / 180));
      }
    }
  }
}

TEST(MeshFile, GlbHasANormalForEachSideOfACrease) {
  for (const int n : {1, 8}) {
    const Mesh mesh = cube_mesh(n);
    const std::string glb = written(mesh, MeshFormat::kGlb);
    tinygltf::Model model;
    std::string error, warning;
    ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &error, &warning,
                                                          reinterpret_cast<const unsigned char*>(glb.data()),
                                                          static_cast<unsigned>(glb.size())));
    const auto& primitive = model.meshes[0].primitives.at(0);
    const auto positions = array_of<float>(model, primitive.attributes.at("POSITION"));
    const auto normals = array_of<float>(model, primitive.attributes.at("NORMAL"));
    const auto triangles = array_of<std::uint32_t>(model, primitive.indices);
    // Each of the 6 sides has vertices of its own.
    EXPECT_EQ(positions.size(), 3u * 6 * (n + 1) * (n + 1));
    EXPECT_EQ(normals.size(), positions.size());
    expect_flat_sides(positions, triangles, normals, triangles);
  }
}

TEST(MeshFile, ObjNamesANormalForEachSideOfACrease) {
  const Mesh mesh = cube_mesh(1);
  const CreaseNormals creases = crease_normals(mesh);
  EXPECT_EQ(creases.normals.size(), 3u * 24);
  expect_flat_sides(mesh.positions, mesh.triangles, creases.normals, creases.corners);
  const std::string obj = written(mesh, MeshFormat::kObj);
  EXPECT_EQ(std::vector<std::string>(absl::StrSplit(obj, "\nv ")).size(), 9u) << obj;
  EXPECT_EQ(std::vector<std::string>(absl::StrSplit(obj, "\nvn ")).size(), 25u) << obj;
}

TEST(MeshFile, MeshesWithoutCreasesKeepTheirVertices) {
  const Mesh mesh = torus_mesh(10, 8, 3, 1);
  const Mesh split = split_at_creases(mesh);
  EXPECT_EQ(split.positions, mesh.positions);
  EXPECT_EQ(split.normals, mesh.normals);
  EXPECT_EQ(split.triangles, mesh.triangles);
}

TEST(MeshFile, FirstSidesKeepTheirVertices) {
  const Mesh mesh = cube_mesh(2), split = split_at_creases(mesh);
  EXPECT_TRUE(split.creases.vertices.empty());
  ASSERT_EQ(split.triangles.size(), mesh.triangles.size());
  std::set<std::uint32_t> seen;
  for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
    if (seen.insert(mesh.triangles[c]).second) {
      EXPECT_EQ(split.triangles[c], mesh.triangles[c]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(split.positions[3 * std::size_t{split.triangles[c]} + axis],
                mesh.positions[3 * std::size_t{mesh.triangles[c]} + axis]);
    }
  }
}

TEST(MeshFile, CreasesCanStaySmooth) {
  const Mesh mesh = cube_mesh(2);
  const TemporaryDirectory directory;
  auto file = OutputFile::create(directory.path("mesh"));
  ASSERT_TRUE(write_mesh(mesh, MeshFormat::kObj, "cube", **file, CreaseShading::kSmooth).ok());
  ASSERT_TRUE((*file)->commit().ok());
  const std::string obj = *read_file(directory.path("mesh"));
  EXPECT_EQ(std::vector<std::string>(absl::StrSplit(obj, "\nvn ")).size(), mesh.vertex_count() + 1);
  EXPECT_TRUE(absl::StrContains(written(mesh, MeshFormat::kPly), "element vertex 26\n"));
}

// JSON is UTF-8, but a file's name may have any bytes.
TEST(MeshFile, AGlbHasItsNameInUtf8) {
  const std::string glb = written(torus_mesh(4, 3, 2.0f, 1.0f), MeshFormat::kGlb, {}, "caf\xe9 \xc3\xa9\n");
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()), static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_EQ(model.meshes.at(0).name, "caf\xef\xbf\xbd \xc3\xa9\n");
  EXPECT_EQ(model.nodes.at(0).name, model.meshes[0].name);
}

TEST(MeshFile, AnEmptyMeshIsAValidGlb) {
  const std::string glb = written(Mesh(), MeshFormat::kGlb);
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()), static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_TRUE(model.meshes.empty());
}

TEST(MeshFile, ObjHasAllVerticesAndFaces) {
  Mesh mesh = torus_mesh(8, 6, 2.0f, 1.0f);
  std::string obj = written(mesh, MeshFormat::kObj);
  std::vector<std::string> lines = absl::StrSplit(obj, '\n');
  const auto count = [&](const char* start) {
    return std::count_if(lines.begin(), lines.end(), [&](const auto& line) { return absl::StartsWith(line, start); });
  };
  EXPECT_EQ(count("v "), 48);
  EXPECT_EQ(count("vn "), 48);
  EXPECT_EQ(count("f "), 96);
  EXPECT_EQ(count("f 1//1 2//2 7//7"), 1) << obj;
  mesh.normals.clear();
  EXPECT_TRUE(absl::StrContains(written(mesh, MeshFormat::kObj), "\nf 1 2 7\n"));
}

TEST(MeshFile, PlyAndStlHaveTheRightSizes) {
  const Mesh mesh = torus_mesh(4, 3, 2.0f, 1.0f);
  const std::string ply = written(mesh, MeshFormat::kPly);
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - body, 12u * 24 + 24u * 13);
  EXPECT_TRUE(absl::StrContains(ply, "element vertex 12\n"));
  const std::string stl = written(mesh, MeshFormat::kStl);
  EXPECT_EQ(stl.size(), 84u + 24u * 50);
  // The first facet's normal points the way of its vertices' normals.
  float normal[3];
  std::memcpy(normal, &stl[84], sizeof(normal));
  EXPECT_GT(normal[0] * mesh.normals[0] + normal[1] * mesh.normals[1] + normal[2] * mesh.normals[2], 0);
}

TEST(MeshFile, WritingIsFast) {
  const Mesh mesh = torus_mesh(1000, 600, 30000.0f, 100.0f);
  for (const auto& [format, name, seconds] :
       {std::tuple(MeshFormat::kGlb, "glb", 0.5), std::tuple(MeshFormat::kPly, "ply", 0.5),
        std::tuple(MeshFormat::kStl, "stl", 0.5), std::tuple(MeshFormat::kObj, "obj", 5.0)}) {
    const TemporaryDirectory directory;
    auto file = OutputFile::create(directory.path("mesh"));
    const double start = processor_seconds();
    EXPECT_TRUE(write_mesh(mesh, format, "torus", **file).ok());
    EXPECT_TRUE((*file)->commit().ok());
    const double took = processor_seconds() - start;
    // The limits are several times what writing takes, so that only a lost order of magnitude fails.
    EXPECT_LT(took, seconds) << name;
    RecordProperty(name, absl::StrCat(took));
    std::printf("%s: %.3f s for %zu triangles\n", name, took, mesh.triangle_count());
  }
}

}  // namespace
}  // namespace isofield
