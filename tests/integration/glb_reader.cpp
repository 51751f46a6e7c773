#include "integration/glb_reader.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

namespace isofield::integration_test {
namespace {

template <class T>
void read_accessor(const tinygltf::Model& model, int index, int component_type, int type, std::vector<T>& out) {
  const tinygltf::Accessor& accessor = model.accessors.at(index);
  ASSERT_EQ(accessor.componentType, component_type);
  ASSERT_EQ(accessor.type, type);
  const tinygltf::BufferView& view = model.bufferViews.at(accessor.bufferView);
  ASSERT_EQ(view.byteStride, 0u);
  const std::vector<unsigned char>& data = model.buffers.at(view.buffer).data;
  out.resize(accessor.count * tinygltf::GetNumComponentsInType(type));
  const std::size_t begin = view.byteOffset + accessor.byteOffset, bytes = out.size() * sizeof(T);
  ASSERT_LE(begin + bytes, data.size());
  ASSERT_LE(accessor.byteOffset + bytes, view.byteLength);
  std::memcpy(out.data(), data.data() + begin, bytes);
}

// Viewers place the camera by these bounds.
void check_bounds(const tinygltf::Accessor& accessor, const std::vector<float>& positions) {
  ASSERT_EQ(accessor.minValues.size(), 3u);
  ASSERT_EQ(accessor.maxValues.size(), 3u);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = positions[axis], high = low;
    for (std::size_t i = axis; i < positions.size(); i += 3) {
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    EXPECT_EQ(static_cast<float>(accessor.minValues[axis]), low);
    EXPECT_EQ(static_cast<float>(accessor.maxValues[axis]), high);
  }
}

}  // namespace

GlbMesh read_glb(const std::string& path) {
  GlbMesh mesh;
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  const bool loaded = loader.LoadBinaryFromFile(&model, &error, &warning, path);
  EXPECT_TRUE(loaded && error.empty() && warning.empty()) << path << ": " << error << warning;
  if (!loaded || model.meshes.empty()) return mesh;
  EXPECT_EQ(model.asset.version, "2.0");
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].primitives.size(), 1u);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
  EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
  const int positions = primitive.attributes.at("POSITION");
  read_accessor(model, positions, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.positions);
  check_bounds(model.accessors.at(positions), mesh.positions);
  if (const auto normals = primitive.attributes.find("NORMAL"); normals != primitive.attributes.end()) {
    read_accessor(model, normals->second, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.normals);
  }
  read_accessor(model, primitive.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, mesh.triangles);
  return mesh;
}

}  // namespace isofield::integration_test
