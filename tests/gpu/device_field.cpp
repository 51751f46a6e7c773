#include "gpu/device_field.h"

#include <gtest/gtest.h>

#include "engine/points/field_evaluator.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using engine::ResultLayout;

std::vector<float> evaluate(const engine::ResidentScene& scene, const std::vector<dvec3>& points, ResultLayout layout) {
  static engine::FieldEvaluator evaluator(device(), kernels(), workers());
  std::vector<float> xyz;
  xyz.reserve(3 * points.size());
  for (const dvec3& p : points) {
    xyz.insert(xyz.end(), {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  std::vector<float> out(points.size() * layout.numbers());
  const absl::Status status = evaluator.evaluate(scene, xyz, layout, out);
  EXPECT_TRUE(status.ok()) << status;
  return out;
}

}  // namespace

std::vector<double> DeviceField::values(const std::vector<dvec3>& points) const {
  const std::vector<float> out = evaluate(*scene_, points, ResultLayout::kValue);
  return {out.begin(), out.end()};
}

std::vector<reference::Sample> DeviceField::samples(const std::vector<dvec3>& points) const {
  const std::vector<float> out = evaluate(*scene_, points, ResultLayout::kValueAndGradient);
  std::vector<reference::Sample> samples;
  for (std::size_t i = 0; i < out.size(); i += 4) samples.push_back({out[i], {out[i + 1], out[i + 2], out[i + 3]}});
  return samples;
}

engine::Mesh DeviceField::mesh(double cell_size) const {
  static engine::Mesher mesher(device(), kernels(), workers());
  auto mesh = mesher.mesh(*scene_, {.cell_size = cell_size}, {});
  EXPECT_TRUE(mesh.ok()) << mesh.status();
  return mesh.ok() ? *std::move(mesh) : engine::Mesh{};
}

dvec3 rounded_to_float(const dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

}  // namespace isofield::gpu_test
