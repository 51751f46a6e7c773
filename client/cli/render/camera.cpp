#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isofield {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr float kMargin = 1.08f;

Vector to_vector(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// The cosine of an angle in degrees, which is exactly 0 at right angles.
double cosine(double degrees) {
  return std::fmod(degrees, 180) == 90 || std::fmod(degrees, 180) == -90 ? 0 : std::cos(degrees * kRadians);
}

// The largest of each expression over all positions; see place_camera.
struct Extremes {
  static constexpr float kLeast = std::numeric_limits<float>::lowest();
  float right = kLeast, left = kLeast, up = kLeast, down = kLeast, nearest = kLeast, farthest = kLeast;
};

// The extremes of the positions about `center`, in axes parallel to the camera's.
Extremes extremes_of(std::span<const float> positions, const Camera& camera, const Vector& center, float tan_x,
                     float tan_y) {
  Extremes most;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const Vector p = Vector{positions[i], positions[i + 1], positions[i + 2]} - center;
    const float u = dot(p, camera.right), v = dot(p, camera.up), w = dot(p, camera.back);
    most.right = std::max(most.right, u + w * tan_x);
    most.left = std::max(most.left, -u + w * tan_x);
    most.up = std::max(most.up, v + w * tan_y);
    most.down = std::max(most.down, -v + w * tan_y);
    most.nearest = std::max(most.nearest, w);
    most.farthest = std::max(most.farthest, -w);
  }
  return most;
}

// Sets target and distance. A point (u, v, w) in axes parallel to the camera's, about a centre near the model, is
// inside the picture of a camera at (cx, cy, d) when |u - cx| <= (d - w) tan_x / margin, and alike for v: two linear
// bounds on d and cx each, whose extremes over the points give the nearest camera.
void place_camera(std::span<const float> positions, const View& view, Camera& camera) {
  Vector low = {positions[0], positions[1], positions[2]};
  Vector high = low;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    low = {std::min(low.x, positions[i]), std::min(low.y, positions[i + 1]), std::min(low.z, positions[i + 2])};
    high = {std::max(high.x, positions[i]), std::max(high.y, positions[i + 1]), std::max(high.z, positions[i + 2])};
  }
  const Vector center = view.target ? to_vector(*view.target) : (low + high) * 0.5f;
  const float tan_x = camera.tan_x / kMargin, tan_y = camera.tan_y / kMargin;
  const Extremes most = extremes_of(positions, camera, center, tan_x, tan_y);
  const float aside = view.target ? 0 : (most.right - most.left) / 2;
  const float above = view.target ? 0 : (most.up - most.down) / 2;
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z, std::numeric_limits<float>::min()});
  camera.target = center + camera.right * aside + camera.up * above;
  camera.distance = view.distance ? static_cast<float>(*view.distance)
                                  : std::max({(most.right - aside) / tan_x, (most.left + aside) / tan_x,
                                              (most.up - above) / tan_y, (most.down + above) / tan_y,
                                              most.nearest + 1e-3f * size});
}

}  // namespace

void View::turn_to(double azimuth, double elevation) {
  const double level = cosine(elevation), rise = cosine(elevation - 90);
  const double right = cosine(azimuth - 90), front = cosine(azimuth);
  direction = {0 - right * level, 0 - rise, 0 - front * level};
  // In a picture from straight above, the front is at the bottom.
  up = level == 0 ? std::array{0 - rise * right, 0.0, 0 - rise * front} : std::array{0.0, 1.0, 0.0};
}

View View::from(double azimuth, double elevation) {
  View view{.direction = {0, 0, -1}};
  view.turn_to(azimuth, elevation);
  return view;
}

Camera fit_camera(std::span<const float> positions, const View& view, double aspect) {
  Camera camera;
  camera.back = normalize(to_vector(view.direction)) * -1;
  camera.right = normalize(cross(to_vector(view.up), camera.back));
  camera.up = cross(camera.back, camera.right);
  const double tangent = std::tan(view.field_of_view / 2 * kRadians);
  camera.tan_x = static_cast<float>(tangent * std::max(1.0, aspect));
  camera.tan_y = static_cast<float>(tangent * std::max(1.0, 1 / aspect));
  place_camera(positions, view, camera);
  const Extremes most = extremes_of(positions, camera, camera.target, 0, 0);
  // Parts of the model may lie behind a camera that is not fitted to it.
  camera.near = std::max(camera.distance - most.nearest, 0.0f);
  camera.far = std::max(camera.distance + most.farthest, camera.near + 1e-3f * camera.distance);
  return camera;
}

}  // namespace isofield
