#include "render/camera.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace isofield {
namespace {

// Half the opening angle along the picture's shorter edge: some perspective, little distortion.
constexpr double kHalfAngle = 14 * std::numbers::pi / 180;
constexpr float kMargin = 1.08f;

// The largest of each expression over all positions; see fit_camera.
struct Extremes {
  float right, left, up, down, nearest, farthest;
};

}  // namespace

Camera fit_camera(std::span<const float> positions, const View& view, double aspect) {
  const double azimuth = view.azimuth * std::numbers::pi / 180;
  const double elevation = view.elevation * std::numbers::pi / 180;
  const auto to_float = [](double v) { return static_cast<float>(v); };
  Camera camera;
  camera.back = {to_float(std::sin(azimuth) * std::cos(elevation)), to_float(std::sin(elevation)),
                 to_float(std::cos(azimuth) * std::cos(elevation))};
  camera.right = {to_float(std::cos(azimuth)), 0, to_float(-std::sin(azimuth))};
  camera.up = cross(camera.back, camera.right);
  const double tangent = std::tan(kHalfAngle);
  camera.tan_x = to_float(tangent * std::max(1.0, aspect));
  camera.tan_y = to_float(tangent * std::max(1.0, 1 / aspect));

  // A point (u, v, w) in axes parallel to the camera's, about a centre near the model, is inside the picture of a
  // camera at (cx, cy, d) when |u - cx| <= (d - w) tan_x / margin, and alike for v: two linear bounds on d and cx
  // each, whose extremes over the points give the nearest camera.
  Vector low = {positions[0], positions[1], positions[2]};
  Vector high = low;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    low = {std::min(low.x, positions[i]), std::min(low.y, positions[i + 1]), std::min(low.z, positions[i + 2])};
    high = {std::max(high.x, positions[i]), std::max(high.y, positions[i + 1]), std::max(high.z, positions[i + 2])};
  }
  const Vector center = (low + high) * 0.5f;
  const float tan_x = camera.tan_x / kMargin;
  const float tan_y = camera.tan_y / kMargin;
  constexpr float kLeast = std::numeric_limits<float>::lowest();
  Extremes most = {kLeast, kLeast, kLeast, kLeast, kLeast, kLeast};
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const Vector p = Vector{positions[i], positions[i + 1], positions[i + 2]} - center;
    const float u = dot(p, camera.right);
    const float v = dot(p, camera.up);
    const float w = dot(p, camera.back);
    most.right = std::max(most.right, u + w * tan_x);
    most.left = std::max(most.left, -u + w * tan_x);
    most.up = std::max(most.up, v + w * tan_y);
    most.down = std::max(most.down, -v + w * tan_y);
    most.nearest = std::max(most.nearest, w);
    most.farthest = std::max(most.farthest, -w);
  }
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z, std::numeric_limits<float>::min()});
  const float distance = std::max(
      {(most.right + most.left) / (2 * tan_x), (most.up + most.down) / (2 * tan_y), most.nearest + 1e-3f * size});
  camera.eye = center + camera.right * ((most.right - most.left) / 2) + camera.up * ((most.up - most.down) / 2) +
               camera.back * distance;
  camera.near = distance - most.nearest;
  camera.far = distance + most.farthest;
  return camera;
}

}  // namespace isofield
