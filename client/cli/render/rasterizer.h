#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "isofield/client.h"
#include "render/camera.h"

namespace isofield {

// The depth and the normal of the surface that is seen at each sample of a picture, row by row from the top.
struct Visibility {
  int width = 0, height = 0;
  // This is 1 / distance along the view axis, or 0 if nothing is seen.
  std::vector<float> inverse_depth;
  // These are x and y of the unit normal in camera space, each scaled to 16 bits with sign. As z is positive, it
  // follows from them.
  std::vector<std::int16_t> normals;

  glm::vec3 normal(std::size_t sample) const {
    const float x = static_cast<float>(normals[2 * sample]) / 32767;
    const float y = static_cast<float>(normals[2 * sample + 1]) / 32767;
    return {x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
  }
};

// Draws the front faces of a mesh, which must have normals. Triangles very near to the camera or behind it are left
// out.
Visibility rasterize(const Mesh& mesh, const Camera& camera, int width, int height);

}  // namespace isofield
