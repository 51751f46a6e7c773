// Tests neurons, a molecule and particles that others made, from file to file by one command line each.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>
#include <isofield/import.h>

#include <cmath>
#include <iostream>

#include "integration/daemon.h"
#include "integration/glb_reader.h"
#include "integration/local_reference.h"
#include "integration/process.h"
#include "integration/temporary_directory.h"
#include "support/mesh_check.h"
#include "support/self_intersection.h"
#include "support/shared_files.h"

namespace isofield::integration_test {
namespace {

using test_support::MeshReport;
using test_support::shared_file;

class RealData : public testing::Test {
 protected:
  // Meshes the file. The vertices and normals are those of the server.
  GlbMesh mesh(const std::string& file, double cell) {
    const Outcome outcome = run({ISOFIELD_COMMAND, "--server", shared_daemon().address(), "mesh", shared_file(file),
                                 "--cell", absl::StrCat(cell), "--smooth-creases", "-o", directory_.path("mesh.glb")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    std::cout << outcome.errors << outcome.output;
    return read_glb(directory_.path("mesh.glb"));
  }
  static MeshReport expect_sound(const GlbMesh& mesh) {
    const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
    std::cout << report.text() << "\n";
    EXPECT_TRUE(report.sound()) << report.text();
    EXPECT_EQ(report.unused_vertices, 0u);
    return report;
  }

  // Checks about `samples` vertices: they lie on the surface to 1 % of a cell, by the linearised distance, and their
  // normals have unit length and point against the gradient.
  static void expect_on_surface(const GlbMesh& mesh, const v1::Scene& scene, double cell, double reference_cell,
                                std::size_t samples) {
    LocalReference exact(scene, reference_cell);
    const std::size_t count = mesh.positions.size() / 3, step = std::max<std::size_t>(count / samples, 1);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    std::size_t looked_at = 0, off = 0, turned = 0, not_unit = 0;
    double furthest = 0, least_cosine = 1;
    for (std::size_t v = 0; v < count; v += step, ++looked_at) {
      const float* const p = &mesh.positions[3 * v];
      const float* const n = &mesh.normals[3 * v];
      const reference::Sample s = exact.evaluate({p[0], p[1], p[2]});
      const double slope = length(s.gradient);
      const double distance = std::abs(s.value - 0.5) / slope / cell;
      off += !(distance <= 0.01);
      furthest = std::max(furthest, distance);
      not_unit += !(std::abs(std::hypot(n[0], n[1], n[2]) - 1) <= 1e-4);
      const double cosine = -(s.gradient.x * n[0] + s.gradient.y * n[1] + s.gradient.z * n[2]) / slope;
      turned += !(cosine >= 0.99);
      least_cosine = std::min(least_cosine, cosine);
    }
    std::cout << looked_at << " of " << count << " vertices: furthest " << furthest
              << " cells off the surface, least cosine of normal and gradient " << least_cosine << ", " << turned
              << " below 0.99\n";
    EXPECT_EQ(off, 0u);
    EXPECT_EQ(not_unit, 0u);
    // The gradient on a crease is that of one of the two sides. Along a seam the normal turns from one side's to the
    // other's.
    EXPECT_LE(turned, looked_at / 400);
  }
  static v1::Scene imported(const std::string& file) {
    auto result = import_file(shared_file(file), {});
    EXPECT_TRUE(result.ok()) << result.status();
    return result.ok() ? std::move(result->scene) : v1::Scene();
  }

  TemporaryDirectory directory_;
};

TEST_F(RealData, ANeuronOfThousandsOfSegmentsIsMeshedByOneCommand) {
  const std::string file = "data/hemibrain_1734350788.swc";
  ISOFIELD_NEEDS_SHARED(file);
  const GlbMesh neuron = mesh(file, 16);
  const MeshReport report = expect_sound(neuron);
  EXPECT_GT(report.vertices, 100'000u);
  const v1::Scene scene = imported(file);
  // The nodes are 4,464 edges less three within the soma, the soma, and their union.
  EXPECT_EQ(scene.nodes_size(), 4463);
  EXPECT_TRUE(scene.nodes(4462).has_gradient());
  expect_on_surface(neuron, scene, 16, 64, 25'000);
  EXPECT_TRUE(test_support::self_intersections(neuron.positions, neuron.triangles).empty());
  // A second run gives the same bytes.
  const std::string first = read_file(directory_.path("mesh.glb"));
  mesh(file, 16);
  EXPECT_TRUE(read_file(directory_.path("mesh.glb")) == first);
}

TEST_F(RealData, ASyntheticNeuronIsMeshed) {
  const std::string file = "data/neurom_synthetic.swc";
  ISOFIELD_NEEDS_SHARED(file);
  const GlbMesh neuron = mesh(file, 0.25);
  expect_sound(neuron);
  expect_on_surface(neuron, imported(file), 0.25, 2, 20'000);
}

TEST_F(RealData, AProteinIsMeshed) {
  const std::string file = "data/1A8O.pdb";
  ISOFIELD_NEEDS_SHARED(file);
  const GlbMesh protein = mesh(file, 0.25);
  expect_sound(protein);
  expect_on_surface(protein, imported(file), 0.25, 2, 20'000);
}

TEST_F(RealData, AThousandSoftParticlesAreMeshed) {
  const std::string file = "data/segment_tracing_particles.txt";
  ISOFIELD_NEEDS_SHARED(file);
  const v1::Scene scene = imported(file);
  ASSERT_GE(scene.nodes_size(), 1001);
  EXPECT_NEAR(scene.nodes(0).sphere().radius(), 0.4542020 * 0.5, 1e-7);
  EXPECT_NEAR(scene.nodes(0).sphere().range(), 0.5457980 * 0.5, 1e-7);
  const GlbMesh particles = mesh(file, 0.05);
  expect_sound(particles);
  expect_on_surface(particles, scene, 0.05, 0.5, 20'000);
}

}  // namespace
}  // namespace isofield::integration_test
