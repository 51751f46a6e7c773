#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "isofield/client.h"
#include "render/camera.h"

namespace isofield {

// What is seen at each sample of a picture, row by row from the top.
struct Visibility {
  int width = 0, height = 0;
  // 1 / distance along the view axis; 0 where nothing is seen.
  std::vector<float> inverse_depth;
  // x and y of the unit normal in camera space, each scaled to 16 bits with sign; z is positive and follows.
  std::vector<std::int16_t> normals;

  glm::vec3 normal(std::size_t sample) const {
    const float x = static_cast<float>(normals[2 * sample]) / 32767;
    const float y = static_cast<float>(normals[2 * sample + 1]) / 32767;
    return {x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
  }
};

// Draws the front faces of a mesh with normals. Triangles that come very near to the camera are left out.
Visibility rasterize(const Mesh& mesh, const Camera& camera, int width, int height);

}  // namespace isofield
