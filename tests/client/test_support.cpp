#include "test_support.h"

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace isofield {

namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (fs::temp_directory_path() / "isofield-test-XXXXXX").string();
  const char* made = ::mkdtemp(pattern.data());
  EXPECT_NE(made, nullptr);
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::size_t TemporaryDirectory::file_count() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
}

std::string write_file(const std::string& path, std::string_view data) {
  std::ofstream(path, std::ios::binary) << data;
  return path;
}

std::string shared_data(const std::string& name) {
  const char* shared = std::getenv("ISOFIELD_SHARED");
  const fs::path root = shared ? fs::path(shared) : fs::path(ISOFIELD_SOURCE_DIR) / ".." / "shared";
  const fs::path path = root / "data" / name;
  return fs::exists(path) ? path.string() : "";
}

Mesh torus_mesh(int rings, int sides, float major_radius, float minor_radius) {
  Mesh mesh;
  const float step = 2 * std::numbers::pi_v<float>;
  for (int i = 0; i < rings; ++i) {
    const float u = step * static_cast<float>(i) / static_cast<float>(rings);
    for (int j = 0; j < sides; ++j) {
      const float v = step * static_cast<float>(j) / static_cast<float>(sides);
      const float nx = std::cos(v) * std::cos(u), ny = std::sin(v), nz = std::cos(v) * std::sin(u);
      mesh.positions.insert(mesh.positions.end(), {major_radius * std::cos(u) + minor_radius * nx, minor_radius * ny,
                                                   major_radius * std::sin(u) + minor_radius * nz});
      mesh.normals.insert(mesh.normals.end(), {nx, ny, nz});
      const auto vertex = [&](int ring, int side) {
        return static_cast<std::uint32_t>((ring % rings) * sides + side % sides);
      };
      mesh.triangles.insert(mesh.triangles.end(), {vertex(i, j), vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j),
                                                   vertex(i, j + 1), vertex(i + 1, j + 1)});
    }
  }
  mesh.summary.set_vertices(mesh.vertex_count());
  mesh.summary.set_triangles(mesh.triangle_count());
  return mesh;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace isofield
