// Reads a GLB file as a viewer does, without any code of its writer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isofield::integration_test {

struct GlbMesh {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> triangles;
};

// Reads a glTF 2.0 binary with at most one mesh of triangles. Any other file fails the test; the result then holds what
// could be read.
GlbMesh read_glb(const std::string& path);

}  // namespace isofield::integration_test
