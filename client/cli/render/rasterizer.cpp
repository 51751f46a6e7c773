#include "render/rasterizer.h"

#include <algorithm>
#include <span>

namespace isofield {
namespace {

// A vertex on the picture: x, y in samples, and 1 / depth, which is linear there; its normal in camera space.
struct Corner {
  float x, y, inverse_depth;
  Vector normal;
};

std::vector<Corner> project(const Mesh& mesh, const Camera& camera, int width, int height) {
  std::vector<Corner> corners(mesh.vertex_count());
  const float scale_x = 0.5f * static_cast<float>(width) / camera.tan_x;
  const float scale_y = 0.5f * static_cast<float>(height) / camera.tan_y;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const float* position = &mesh.positions[3 * i];
    const float* normal = &mesh.normals[3 * i];
    const Vector p = camera.to_camera({position[0], position[1], position[2]});
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

class Painter {
 public:
  Painter(int width, int height) {
    seen_.width = width;
    seen_.height = height;
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    seen_.inverse_depth.assign(samples, 0);
    seen_.normals.resize(2 * samples);
  }

  void draw(const Corner& a, const Corner& b, const Corner& c) {
    // Rows go down, so a counter-clockwise triangle has a negative area here.
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(area < 0)) return;
    const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - 0.5f)));
    const int x1 = std::min(seen_.width - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - 0.5f)));
    const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - 0.5f)));
    const int y1 = std::min(seen_.height - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - 0.5f)));
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
        const Vector normal = normalize(a.normal * of_a + b.normal * of_b + c.normal * of_c);
        seen_.normals[2 * sample] = pack(normal.x);
        seen_.normals[2 * sample + 1] = pack(normal.y);
      }
    }
  }

  Visibility take() { return std::move(seen_); }

 private:
  Visibility seen_;
};

}  // namespace

Visibility rasterize(const Mesh& mesh, const Camera& camera, int width, int height) {
  const std::vector<Corner> corners = project(mesh, camera, width, height);
  Painter painter(width, height);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    painter.draw(corners[mesh.triangles[i]], corners[mesh.triangles[i + 1]], corners[mesh.triangles[i + 2]]);
  }
  return painter.take();
}

}  // namespace isofield
