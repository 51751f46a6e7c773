#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace isofield {

// From where a picture is taken. Model space is right-handed with y up, as glTF has it; lengths are in model units.
struct View {
  // A view from a side. The azimuth is in degrees around y: 0 looks from the front (along -z), 90 from the right (along
  // -x). The elevation is in degrees above the horizon, within [-90, 90].
  static View from(double azimuth, double elevation);
  // Sets direction and up to look from there, and keeps everything else.
  void turn_to(double azimuth, double elevation);

  // The direction in which the camera looks, of any length but 0.
  glm::dvec3 direction = from(35, 20).direction;
  // The direction that is upwards in the picture; not parallel to `direction`.
  glm::dvec3 up = {0, 1, 0};
  // Degrees, within [1, 150]: the whole opening angle along the picture's shorter edge. Some perspective, little
  // distortion.
  double field_of_view = 28;
  // The point that the camera looks at, and its distance from the camera. Where they are left out, they are chosen so
  // that the model fills the picture.
  std::optional<glm::dvec3> target;
  std::optional<double> distance;

  bool operator==(const View&) const = default;
};

// A perspective camera. Camera space: x right, y up, z towards the viewer; the camera looks along -z from its origin.
struct Camera {
  glm::vec3 right{}, up{}, back{};  // unit axes of camera space in model space
  glm::vec3 target{};               // model space
  float distance = 1;               // from the target
  float tan_x = 1, tan_y = 1;       // of half the opening angles
  float near = 0, far = 1;          // distances along the view that enclose what is seen of the model; 0 <= near < far

  glm::vec3 to_camera(const glm::vec3& position) const {
    const glm::vec3 p = position - target;
    return {glm::dot(p, right), glm::dot(p, up), glm::dot(p, back) - distance};
  }
  glm::vec3 turn_to_camera(const glm::vec3& direction) const {
    return {glm::dot(direction, right), glm::dot(direction, up), glm::dot(direction, back)};
  }
};

// The camera of a view. What the view leaves open is chosen so that the camera is as near as possible while its picture
// (width / height = aspect) holds all positions ([n, 3], n >= 1) with a margin around them.
Camera fit_camera(std::span<const float> positions, const View& view, double aspect);

}  // namespace isofield
