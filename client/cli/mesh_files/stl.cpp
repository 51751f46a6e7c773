#include <algorithm>
#include <array>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "mesh_files/mesh_file.h"

namespace isofield {
namespace {

glm::vec3 corner(const Mesh& mesh, std::size_t index) {
  const float* position = &mesh.positions[3 * std::size_t{mesh.triangles[index]}];
  return {position[0], position[1], position[2]};
}

// Returns the unit normal of a triangle, or (0, 0, 0) for one without area, as the format wants it.
glm::vec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 n = glm::cross(b - a, c - a);
  const float length = glm::length(n);
  return length > 0 ? n / length : glm::vec3(0);
}

}  // namespace

absl::Status write_stl(const Mesh& mesh, const std::string& unit, OutputFile& file) {
  if (mesh.triangle_count() > std::numeric_limits<std::uint32_t>::max()) {
    return absl::OutOfRangeError("an STL file holds at most 2^32 - 1 triangles; write .ply");
  }
  std::array<char, 80> header{};
  const std::string comment = unit.empty() ? "isofield" : "isofield UNITS=" + unit;
  std::memcpy(header.data(), comment.data(), std::min(comment.size(), header.size()));
  const auto count = static_cast<std::uint32_t>(mesh.triangle_count());
  absl::Status status = file.write(header.data(), header.size());
  status.Update(file.write(&count, sizeof(count)));
  for (std::size_t i = 0; status.ok() && i < mesh.triangles.size(); i += 3) {
    const glm::vec3 a = corner(mesh, i);
    const glm::vec3 b = corner(mesh, i + 1);
    const glm::vec3 c = corner(mesh, i + 2);
    const std::array<glm::vec3, 4> numbers = {normal_of(a, b, c), a, b, c};
    std::array<char, sizeof(numbers) + 2> facet{};  // two bytes of attributes: 0
    std::memcpy(facet.data(), numbers.data(), sizeof(numbers));
    status = file.write(facet.data(), facet.size());
  }
  return status;
}

}  // namespace isofield
