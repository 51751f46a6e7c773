#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "mesh_files/mesh_file.h"

namespace isofield {
namespace {

using Vector = std::array<float, 3>;

Vector corner(const Mesh& mesh, std::size_t index) {
  const float* position = &mesh.positions[3 * std::size_t{mesh.triangles[index]}];
  return {position[0], position[1], position[2]};
}

// (0, 0, 0) for a triangle without area, as the format has it.
Vector normal_of(const Vector& a, const Vector& b, const Vector& c) {
  const Vector u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Vector v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  Vector n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (float& component : n) component = length > 0 ? component / length : 0;
  return n;
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
    const Vector a = corner(mesh, i);
    const Vector b = corner(mesh, i + 1);
    const Vector c = corner(mesh, i + 2);
    const std::array<Vector, 4> numbers = {normal_of(a, b, c), a, b, c};
    std::array<char, sizeof(numbers) + 2> facet{};  // two bytes of attributes: 0
    std::memcpy(facet.data(), numbers.data(), sizeof(numbers));
    status = file.write(facet.data(), facet.size());
  }
  return status;
}

}  // namespace isofield
