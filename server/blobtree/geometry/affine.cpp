#include "blobtree/geometry/affine.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace isofield::blobtree {
namespace {

// glm stores matrices by columns, so the rows are transposed on the way in and on the way out.
glm::dmat3 to_glm(const std::array<dvec3, 3>& rows) {
  glm::dmat3 m;
  for (int r = 0; r < 3; ++r) m[0][r] = rows[r].x, m[1][r] = rows[r].y, m[2][r] = rows[r].z;
  return m;
}
std::array<dvec3, 3> from_glm(const glm::dmat3& m) {
  std::array<dvec3, 3> rows;
  for (int r = 0; r < 3; ++r) rows[r] = {m[0][r], m[1][r], m[2][r]};
  return rows;
}

}  // namespace

Affine Affine::after(const Affine& other) const {
  return {from_glm(to_glm(linear) * to_glm(other.linear)), point(other.offset)};
}

std::optional<Affine> Affine::inverse() const {
  const glm::dmat3 m = to_glm(linear);
  const double determinant = glm::determinant(m);
  if (determinant == 0 || !std::isfinite(determinant)) return std::nullopt;
  Affine inverse{from_glm(glm::inverse(m)), {}};
  inverse.offset = dvec3{} - inverse.vector(offset);
  return inverse;
}

Affine::Stretch Affine::stretch() const {
  // The singular values are the square roots of the eigenvalues of A^T A. Jacobi rotations make this matrix diagonal.
  const glm::dmat3 m = to_glm(linear);
  glm::dmat3 s = glm::transpose(m) * m;
  bool is_diagonal = false;
  for (int sweep = 0; sweep < 30 && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(s[p][q]) <= 1e-17 * std::sqrt(std::abs(s[p][p] * s[q][q]))) continue;
        is_diagonal = false;
        const double angle = 0.5 * std::atan2(2 * s[p][q], s[q][q] - s[p][p]);
        glm::dmat3 j(1);
        j[p][p] = j[q][q] = std::cos(angle);
        j[q][p] = std::sin(angle);
        j[p][q] = -j[q][p];
        s = glm::transpose(j) * s * j;
      }
    }
  }
  const auto [least, most] = std::minmax({s[0][0], s[1][1], s[2][2]});
  return {std::sqrt(std::max(least, 0.0)), std::sqrt(most)};
}

bool Affine::is_similarity(double tolerance) const {
  const Stretch s = stretch();
  return s.most - s.least <= tolerance * s.most;
}

Affine::LowerTriangle Affine::gradient_frame() const {
  // Gram-Schmidt on the rows of A gives A = L Q with the rows of Q orthonormal, without squaring the condition number.
  LowerTriangle l{};
  std::array<dvec3, 3> q;
  std::size_t at = 0;
  for (int row = 0; row < 3; ++row) {
    dvec3 rest = linear[row];
    for (int k = 0; k < row; ++k) {
      l[at] = dot(rest, q[k]);
      rest = rest - q[k] * l[at++];
    }
    l[at] = length(rest);
    q[row] = rest * (1 / l[at++]);
  }
  return l;
}

Affine Affine::rotation(const dvec3& axis, double angle) {
  const dvec3 u = axis * (1 / length(axis));
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  return {{{{t * u.x * u.x + c, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y},
            {t * u.x * u.y + s * u.z, t * u.y * u.y + c, t * u.y * u.z - s * u.x},
            {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, t * u.z * u.z + c}}},
          {}};
}

Affine Affine::frame(const dvec3& origin, const dvec3& direction) {
  const dvec3 z = direction * (1 / length(direction));
  const dvec3 helper = std::abs(z.x) < 0.7 ? dvec3{1, 0, 0} : dvec3{0, 1, 0};
  dvec3 x = cross(helper, z);
  x = x * (1 / length(x));
  const dvec3 y = cross(z, x);
  return {{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}, origin};
}

}  // namespace isofield::blobtree
