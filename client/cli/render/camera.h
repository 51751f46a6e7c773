#pragma once

#include <span>

#include "render/vector.h"

namespace isofield {

// Where the camera stands. Model space is right-handed with y up, as glTF has it.
struct View {
  // Degrees around y: 0 looks at the front (along -z), 90 at the right side (along -x).
  double azimuth = 35;
  // Degrees above the horizon, within [-90, 90].
  double elevation = 20;
};

// A perspective camera. Camera space: x right, y up, z towards the viewer; the camera looks along -z from its origin.
struct Camera {
  Vector right, up, back;      // unit axes of camera space in model space
  Vector eye;                  // model space
  float tan_x = 1, tan_y = 1;  // of half the opening angles
  float near = 0, far = 1;     // distances that enclose the model

  Vector to_camera(const Vector& position) const {
    const Vector p = position - eye;
    return {dot(p, right), dot(p, up), dot(p, back)};
  }
  Vector turn_to_camera(const Vector& direction) const {
    return {dot(direction, right), dot(direction, up), dot(direction, back)};
  }
};

// The nearest camera of that view whose picture (width / height = aspect) holds all positions ([n, 3], n >= 1) with a
// margin around them.
Camera fit_camera(std::span<const float> positions, const View& view, double aspect);

}  // namespace isofield
