#include "render/rasterizer.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "render/bands.h"
#include "render/unit_vector.h"

namespace isofield {
namespace {

// The least depth that is drawn, as a part of the camera's distance from its target.
constexpr float kNearest = 1e-3f;

// A vertex on the picture: x and y in samples, and 1 / depth, which is linear on the picture; its normal is in camera
// space. inverse_depth is 0 where the vertex is too near to be drawn.
struct Corner {
  float x = 0, y = 0, inverse_depth = 0;
  glm::vec3 normal{};
};

// These round x up or down to a whole number, within [0, most] and [-1, most]. They clamp x first, because it may be
// far outside of the picture, where a conversion to int would be undefined.
int ceiling(float x, int most) {
  return static_cast<int>(std::ceil(std::clamp(x, 0.0f, static_cast<float>(most))));
}
int floor(float x, int most) {
  return static_cast<int>(std::floor(std::clamp(x, -1.0f, static_cast<float>(most))));
}

std::vector<Corner> project(const Mesh& mesh, const Camera& camera, int width, int height) {
  std::vector<Corner> corners(mesh.vertex_count());
  const float scale_x = 0.5f * static_cast<float>(width) / camera.tan_x;
  const float scale_y = 0.5f * static_cast<float>(height) / camera.tan_y;
  const float nearest = kNearest * camera.distance;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const float* position = &mesh.positions[3 * i];
    const float* normal = &mesh.normals[3 * i];
    const glm::vec3 p = camera.to_camera({position[0], position[1], position[2]});
    if (!(-p.z >= nearest)) continue;
    const float inverse_depth = -1 / p.z;
    corners[i] = {0.5f * static_cast<float>(width) + p.x * inverse_depth * scale_x,
                  0.5f * static_cast<float>(height) - p.y * inverse_depth * scale_y, inverse_depth,
                  camera.turn_to_camera({normal[0], normal[1], normal[2]})};
  }
  return corners;
}

std::int16_t pack(float component) {
  return static_cast<std::int16_t>(std::lround(component * 32767));
}

// Draws triangles into the rows [first, last) of the picture.
class Painter {
 public:
  Painter(Visibility& seen, int first, int last) : seen_(seen), first_row_(first), last_row_(last - 1) {}

  void draw(const Corner& a, const Corner& b, const Corner& c) {
    if (a.inverse_depth == 0 || b.inverse_depth == 0 || c.inverse_depth == 0) return;
    // Rows go down, so a counter-clockwise triangle, which is a front face, has a negative area here.
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(area < 0)) return;
    const int x0 = ceiling(std::min({a.x, b.x, c.x}) - 0.5f, seen_.width);
    const int x1 = floor(std::max({a.x, b.x, c.x}) - 0.5f, seen_.width - 1);
    const int y0 = std::max(first_row_, ceiling(std::min({a.y, b.y, c.y}) - 0.5f, seen_.height));
    const int y1 = std::min(last_row_, floor(std::max({a.y, b.y, c.y}) - 0.5f, seen_.height - 1));
    const float scale = 1 / area;
    for (int y = y0; y <= y1; ++y) {
      const float py = static_cast<float>(y) + 0.5f;
      for (int x = x0; x <= x1; ++x) {
        const float px = static_cast<float>(x) + 0.5f;
        const float of_b = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) * scale;
        const float of_c = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) * scale;
        const float of_a = 1 - of_b - of_c;
        if (of_a < 0 || of_b < 0 || of_c < 0) continue;
        const float inverse_depth = of_a * a.inverse_depth + of_b * b.inverse_depth + of_c * c.inverse_depth;
        const std::size_t sample =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(seen_.width) + static_cast<std::size_t>(x);
        if (inverse_depth <= seen_.inverse_depth[sample]) continue;
        seen_.inverse_depth[sample] = inverse_depth;
        const glm::vec3 normal = unit_vector(a.normal * of_a + b.normal * of_b + c.normal * of_c);
        seen_.normals[2 * sample] = pack(normal.x);
        seen_.normals[2 * sample + 1] = pack(normal.y);
      }
    }
  }

 private:
  Visibility& seen_;
  const int first_row_, last_row_;
};

}  // namespace

Visibility rasterize(const Mesh& mesh, const Camera& camera, int width, int height) {
  const std::vector<Corner> corners = project(mesh, camera, width, height);
  Visibility seen;
  seen.width = width;
  seen.height = height;
  const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  seen.inverse_depth.assign(samples, 0);
  seen.normals.resize(2 * samples);
  for_each_band(height, [&](int first, int last) {
    Painter painter(seen, first, last);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      painter.draw(corners[mesh.triangles[i]], corners[mesh.triangles[i + 1]], corners[mesh.triangles[i + 2]]);
    }
  });
  return seen;
}

}  // namespace isofield
