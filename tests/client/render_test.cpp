#include "render/render.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstdlib>

#include "isofield/scene_file.h"
#include "render/rasterizer.h"
#include "test_support.h"

namespace isofield {
namespace {

struct Box {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
};

// Where anything is seen.
Box covered(const Visibility& seen) {
  Box box;
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      if (seen.inverse_depth[static_cast<std::size_t>(y * seen.width + x)] == 0) continue;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  }
  return box;
}

TEST(Camera, HoldsTheModelWithAMarginInEveryView) {
  const Mesh mesh = torus_mesh(100, 50, 3.0f, 0.5f);
  for (const View view : {View{0, 0}, View{35, 20}, View{123, -45}, View{0, 90}, View{180, -90}}) {
    for (const auto& [width, height] : {std::pair(400, 300), std::pair(200, 400), std::pair(300, 300)}) {
      const Camera camera = fit_camera(mesh.positions, view, static_cast<double>(width) / height);
      const Box box = covered(rasterize(mesh, camera, width, height));
      EXPECT_GT(box.x0, 0);
      EXPECT_GT(box.y0, 0);
      EXPECT_LT(box.x1, width - 1);
      EXPECT_LT(box.y1, height - 1);
      // One of the two directions fills the picture, up to the margin of 8 %.
      EXPECT_GT(std::max(static_cast<double>(box.x1 - box.x0) / width, static_cast<double>(box.y1 - box.y0) / height),
                0.85);
    }
  }
}

TEST(Rasterizer, ShowsTheNearestFrontFace) {
  const Mesh mesh = torus_mesh(200, 100, 1.0f, 0.5f);
  const Camera camera = fit_camera(mesh.positions, View{0, 90}, 1);
  const Visibility seen = rasterize(mesh, camera, 301, 301);
  // From above: a ring with a hole, its crest nearest and its normal there towards the viewer.
  EXPECT_EQ(seen.inverse_depth[150 * 301 + 150], 0);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < seen.inverse_depth.size(); ++i) {
    if (seen.inverse_depth[i] > seen.inverse_depth[nearest]) nearest = i;
  }
  EXPECT_NEAR(seen.normal(nearest).z, 1, 1e-2);
  EXPECT_NEAR(1 / seen.inverse_depth[nearest], camera.near, 1e-2);
}

TEST(Render, IsDeterministicAndFast) {
  const Mesh mesh = torus_mesh(1000, 600, 3.0f, 1.2f);
  RenderOptions options;
  options.width = 1600;
  options.height = 1200;
  const double start = processor_seconds();
  const auto image = render(mesh, options);
  const double took = processor_seconds() - start;
  ASSERT_TRUE(image.ok()) << image.status();
  std::printf("rendering: %.3f s for %zu triangles\n", took, mesh.triangle_count());
  EXPECT_LT(took, 4);
  EXPECT_EQ(render(mesh, options)->rgb, image->rgb);
}

TEST(Render, PngReadsBack) {
  const TemporaryDirectory directory;
  const char* keep = std::getenv("ISOFIELD_TEST_PICTURE");
  const std::string path = keep ? keep : directory.path("torus.png");
  RenderOptions options;
  options.width = 400;
  options.height = 300;
  const auto image = render(torus_mesh(200, 100, 3.0f, 1.2f), options);
  ASSERT_TRUE(image.ok());
  auto file = OutputFile::create(path);
  ASSERT_TRUE(write_png(*image, **file).ok());
  ASSERT_TRUE((*file)->commit().ok());
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&png, path.c_str()));
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(png));
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr));
  EXPECT_EQ(rgb, image->rgb);
}

TEST(Render, OddInput) {
  EXPECT_TRUE(render(Mesh(), {}).ok());
  Mesh mesh = torus_mesh(8, 8, 3.0f, 1.2f);
  RenderOptions options;
  options.width = 1;
  EXPECT_EQ(render(mesh, options).status().code(), absl::StatusCode::kInvalidArgument);
  mesh.normals.clear();
  EXPECT_EQ(render(mesh, {}).status().code(), absl::StatusCode::kInvalidArgument);
  // All vertices in one place.
  mesh = torus_mesh(8, 8, 0.0f, 0.0f);
  EXPECT_TRUE(render(mesh, {}).ok());
}

}  // namespace
}  // namespace isofield
