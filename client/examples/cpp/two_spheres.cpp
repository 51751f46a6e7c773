// This program stores a scene of two blended spheres on the server, asks for the field between them, and meshes them.
// Usage: two_spheres [ADDRESS]
#include <isofield/client.h>

#include <cstdio>
#include <iostream>

namespace {

isofield::v1::Node& add_sphere(isofield::v1::Scene& scene, double x) {
  auto& node = *scene.add_nodes();
  auto& sphere = *node.mutable_sphere();
  for (const double coordinate : {x, 0.0, 0.0}) sphere.add_center(coordinate);
  sphere.set_radius(0.8);
  sphere.set_range(0.6);
  return node;
}

absl::Status run(const std::string& address) {
  isofield::v1::Scene scene;
  add_sphere(scene, -0.7).set_name("left");
  add_sphere(scene, 0.7).set_name("right");
  auto& blend = *scene.add_nodes()->mutable_gradient();  // the last node is the model
  blend.add_children("left");
  blend.add_children("right");

  auto client = isofield::Client::connect(address);
  if (!client.ok()) return client.status();
  const auto stored = client->put_scene("two-spheres", scene);
  if (!stored.ok()) return stored.status();

  const auto spheres = isofield::scene_by_name("two-spheres");
  const auto field = client->evaluate(spheres, std::vector<float>{0, 0, 0, 0, 0.5f, 0}, /*gradient=*/true);
  if (!field.ok()) return field.status();
  for (std::size_t i = 0; i < field->size(); i += 4) {
    std::printf("value %g, gradient (%g, %g, %g)\n", (*field)[i], (*field)[i + 1], (*field)[i + 2], (*field)[i + 3]);
  }

  isofield::v1::MeshRequest request;
  *request.mutable_scene() = spheres;
  request.set_resolution(100);
  const auto mesh = client->mesh(request, [](const isofield::v1::MeshProgress& progress) {
    std::fprintf(stderr, "\rmeshing: %3.0f %%", 100 * progress.fraction());
    return true;  // false would cancel
  });
  if (!mesh.ok()) return mesh.status();
  std::printf("\n%zu vertices, %zu triangles\n", mesh->vertex_count(), mesh->triangle_count());
  return client->delete_scene("two-spheres");
}

}  // namespace

int main(int argc, char** argv) {
  const absl::Status status = run(argc > 1 ? argv[1] : "127.0.0.1:50051");
  if (!status.ok()) std::cerr << status << "\n";
  return status.ok() ? 0 : 1;
}
