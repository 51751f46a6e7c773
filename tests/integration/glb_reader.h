// A GLB file read as a viewer does, with nothing of what wrote it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isofield::integration_test {

struct GlbMesh {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> triangles;
};

// Fails the test, and returns what it has, where the file is no glTF 2.0 binary with at most one mesh of triangles.
GlbMesh read_glb(const std::string& path);

}  // namespace isofield::integration_test
