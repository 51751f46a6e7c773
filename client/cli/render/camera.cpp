#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "render/unit_vector.h"

namespace isofield {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr float kMargin = 1.08f;

// Returns the cosine of an angle in degrees, which is exactly 0 at right angles.
double cosine(double degrees) {
  return std::fmod(degrees, 180) == 90 || std::fmod(degrees, 180) == -90 ? 0 : std::cos(degrees * kRadians);
}

// The largest values of the expressions in extremes_of() over all positions; place_camera() explains them.
struct Extremes {
  static constexpr float kLeast = std::numeric_limits<float>::lowest();
  float right = kLeast, left = kLeast, up = kLeast, down = kLeast, nearest = kLeast, farthest = kLeast;
};

// Returns the extremes of the positions about `center`, in axes parallel to the camera's.
Extremes extremes_of(std::span<const float> positions, const Camera& camera, const glm::vec3& center, float tan_x,
                     float tan_y) {
  Extremes most;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const glm::vec3 p = glm::vec3{positions[i], positions[i + 1], positions[i + 2]} - center;
    const float u = glm::dot(p, camera.right), v = glm::dot(p, camera.up), w = glm::dot(p, camera.back);
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
// inside the picture of a camera at (cx, cy, d) if |u - cx| <= (d - w) tan_x / margin, and likewise for v. These are
// two linear bounds on d and cx, and two on d and cy; their extremes over the points give the nearest camera.
void place_camera(std::span<const float> positions, const View& view, Camera& camera) {
  glm::vec3 low = {positions[0], positions[1], positions[2]};
  glm::vec3 high = low;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const glm::vec3 p = {positions[i], positions[i + 1], positions[i + 2]};
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 center = view.target ? glm::vec3(*view.target) : (low + high) * 0.5f;
  const float tan_x = camera.tan_x / kMargin, tan_y = camera.tan_y / kMargin;
  const Extremes most = extremes_of(positions, camera, center, tan_x, tan_y);
  const float aside = view.target ? 0 : (most.right - most.left) / 2;
  const float above = view.target ? 0 : (most.up - most.down) / 2;
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z, std::numeric_limits<float>::min()});
  camera.target = center + camera.right * aside + camera.up * above;
  camera.distance =
      view.distance ? static_cast<float>(*view.distance)
                    : std::max({(most.right - aside) / tan_x, (most.left + aside) / tan_x, (most.up - above) / tan_y,
                                (most.down + above) / tan_y, most.nearest + 1e-3f * size});
}

}  // namespace

void View::turn_to(double azimuth, double elevation) {
  const double level = cosine(elevation), rise = cosine(elevation - 90);
  const double right = cosine(azimuth - 90), front = cosine(azimuth);
  direction = {0 - right * level, 0 - rise, 0 - front * level};
  // A picture from straight above has the front at the bottom.
  up = level == 0 ? glm::dvec3(0 - rise * right, 0, 0 - rise * front) : glm::dvec3(0, 1, 0);
}

View View::from(double azimuth, double elevation) {
  View view{.direction = {0, 0, -1}};
  view.turn_to(azimuth, elevation);
  return view;
}

Camera fit_camera(std::span<const float> positions, const View& view, double aspect) {
  Camera camera;
  camera.back = -unit_vector(glm::vec3(view.direction));
  camera.right = unit_vector(glm::cross(glm::vec3(view.up), camera.back));
  camera.up = glm::cross(camera.back, camera.right);
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
