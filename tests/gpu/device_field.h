// A scene on the device, asked for its field at points and for its mesh.
#pragma once

#include <vector>

#include "blobtree/geometry/vec3.h"
#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "reference/evaluator.h"

namespace isofield::gpu_test {

class DeviceField {
 public:
  explicit DeviceField(const v1::Scene& scene) : scene_(resident(scene)) {}

  // At the points rounded to float32. A failure of the evaluation fails the test.
  std::vector<double> values(const std::vector<blobtree::dvec3>& points) const;
  std::vector<reference::Sample> samples(const std::vector<blobtree::dvec3>& points) const;
  // Empty, and the test fails, where it cannot be made.
  engine::Mesh mesh(double cell_size) const;

 private:
  engine::SceneLease scene_;
};

blobtree::dvec3 rounded_to_float(const blobtree::dvec3& p);

}  // namespace isofield::gpu_test
