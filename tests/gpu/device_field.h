// Evaluates a scene on the GPU for tests: its field at points, and its mesh.
#pragma once

#include <vector>

#include "blobtree/geometry/vec3.h"
#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "reference/evaluator.h"

namespace isofield::gpu_test {

// Owns the resident form of one scene. A refused scene ends the process.
class DeviceField {
 public:
  explicit DeviceField(const v1::Scene& scene) : scene_(resident(scene)) {}

  // Evaluate the field at the points rounded to float32. If the evaluation fails, the test fails.
  std::vector<double> values(const std::vector<blobtree::dvec3>& points) const;
  std::vector<reference::Sample> samples(const std::vector<blobtree::dvec3>& points) const;
  // Makes a mesh. If it cannot be made, the test fails and the mesh is empty.
  engine::Mesh mesh(double cell_size) const;

 private:
  engine::SceneLease scene_;
};

blobtree::dvec3 rounded_to_float(const blobtree::dvec3& p);

}  // namespace isofield::gpu_test
