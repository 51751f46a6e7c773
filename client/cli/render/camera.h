#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace isofield {

// Says from where a picture is taken. Model space is right-handed with y up, as in glTF; lengths are in model units.
struct View {
  // Returns a view from a side. The azimuth is in degrees around y: 0 looks from the front (along -z), 90 from the
  // right (along -x). The elevation is in degrees above the horizon, within [-90, 90].
  static View from(double azimuth, double elevation);
  // Sets direction and up to look from there, and keeps everything else.
  void turn_to(double azimuth, double elevation);

  // The direction in which the camera looks, of any length but 0.
  glm::dvec3 direction = from(35, 20).direction;
  // The direction that is upwards in the picture; not parallel to `direction`.
  glm::dvec3 up = {0, 1, 0};
  // The whole opening angle along the picture's shorter edge in degrees, within [1, 150]. The default shows some
  // perspective and little distortion.
  double field_of_view = 28;
  // The point that the camera looks at, and its distance from the camera. If they are left out, they are chosen so that
  // the model fills the picture.
  std::optional<glm::dvec3> target;
  std::optional<double> distance;

  bool operator==(const View&) const = default;
};

// A perspective camera. Camera space: x right, y up, z towards the viewer; the camera looks along -z from its origin.
struct Camera {
  glm::vec3 right{}, up{}, back{};  // unit axes of camera space in model space
  glm::vec3 target{};               // model space
  float distance = 1;               // distance from the target
  float tan_x = 1, tan_y = 1;       // tangents of half the opening angles
  float near = 0, far = 1;          // distances along the view that enclose what is seen of the model; 0 <= near < far

  glm::vec3 to_camera(const glm::vec3& position) const {
    const glm::vec3 p = position - target;
    return {glm::dot(p, right), glm::dot(p, up), glm::dot(p, back) - distance};
  }
  glm::vec3 turn_to_camera(const glm::vec3& direction) const {
    return {glm::dot(direction, right), glm::dot(direction, up), glm::dot(direction, back)};
  }
};

// Returns the camera of a view. The target and distance that the view leaves open are chosen so that the camera is as
// near as possible while its picture (width / height = aspect) holds all positions ([n, 3], n >= 1) with a margin.
Camera fit_camera(std::span<const float> positions, const View& view, double aspect);

}  // namespace isofield
