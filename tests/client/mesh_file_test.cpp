#include "mesh_files/mesh_file.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>

#include "isofield/scene_file.h"
#include "test_support.h"

namespace isofield {
namespace {

std::string written(const Mesh& mesh, MeshFormat format) {
  const TemporaryDirectory directory;
  const std::string path = directory.path("mesh");
  auto file = OutputFile::create(path);
  EXPECT_TRUE(file.ok()) << file.status();
  EXPECT_TRUE(write_mesh(mesh, format, "a \"torus\"", **file).ok());
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
  Mesh mesh = torus_mesh(4, 3, 2.0f, 1.0f);
  std::string obj = written(mesh, MeshFormat::kObj);
  std::vector<std::string> lines = absl::StrSplit(obj, '\n');
  const auto count = [&](const char* start) {
    return std::count_if(lines.begin(), lines.end(), [&](const auto& line) { return absl::StartsWith(line, start); });
  };
  EXPECT_EQ(count("v "), 12);
  EXPECT_EQ(count("vn "), 12);
  EXPECT_EQ(count("f "), 24);
  EXPECT_EQ(count("f 1//1 2//2 4//4"), 1) << obj;
  mesh.normals.clear();
  EXPECT_TRUE(absl::StrContains(written(mesh, MeshFormat::kObj), "\nf 1 2 4\n"));
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
    // Several times what it takes here, so that only a lost order of magnitude fails.
    EXPECT_LT(took, seconds) << name;
    RecordProperty(name, absl::StrCat(took));
    std::printf("%s: %.3f s for %zu triangles\n", name, took, mesh.triangle_count());
  }
}

}  // namespace
}  // namespace isofield
