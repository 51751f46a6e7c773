#include "render/render.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstdlib>

#include "isofield/scene_file.h"
#include "render/rasterizer.h"
#include "render/view_file.h"
#include "test_support.h"

namespace isofield {
namespace {

struct Box {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
};

// Returns the box of the pixels that show anything.
Box covered(const Visibility& seen) {
  Box box;
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      if (seen.inverse_depth[static_cast<std::size_t>(y) * seen.width + x] == 0) continue;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  }
  return box;
}

TEST(Camera, HoldsTheModelWithAMarginInEveryView) {
  const Mesh mesh = torus_mesh(100, 50, 3.0f, 0.5f);
  for (const View& view :
       {View::from(0, 0), View::from(35, 20), View::from(123, -45), View::from(0, 90), View::from(180, -90)}) {
    for (const auto& [width, height] : {std::pair(400, 300), std::pair(200, 400), std::pair(300, 300)}) {
      const Camera camera = fit_camera(mesh.positions, view, static_cast<double>(width) / height);
      const Box box = covered(rasterize(mesh, camera, width, height));
      EXPECT_GT(box.x0, 0);
      EXPECT_GT(box.y0, 0);
      EXPECT_LT(box.x1, width - 1);
      EXPECT_LT(box.y1, height - 1);
      // The model fills one of the two directions of the picture, up to the margin of 8 %.
      EXPECT_GT(std::max(static_cast<double>(box.x1 - box.x0) / width, static_cast<double>(box.y1 - box.y0) / height),
                0.85);
    }
  }
}

TEST(Camera, StandsWhereTheViewSays) {
  const Mesh mesh = torus_mesh(100, 50, 3.0f, 0.5f);
  View view = View::from(90, 0);
  view.target = {1, 2, 3};
  view.distance = 5;
  view.field_of_view = 90;
  const Camera camera = fit_camera(mesh.positions, view, 2);
  // The camera looks from the right side: x points at the viewer, and z to the left.
  const glm::vec3 eye = camera.to_camera({6, 2, 3}), beside = camera.to_camera({1, 2, 2});
  EXPECT_NEAR(std::sqrt(dot(eye, eye)), 0, 1e-5);
  EXPECT_NEAR(beside.x, 1, 1e-5);
  EXPECT_NEAR(beside.z, -5, 1e-5);
  EXPECT_NEAR(camera.tan_y, 1, 1e-5);
  EXPECT_NEAR(camera.tan_x, 2, 1e-5);
  view.up = {0, 0, 1};
  EXPECT_NEAR(fit_camera(mesh.positions, view, 2).to_camera({1, 2, 4}).y, 1, 1e-5);
}

TEST(Camera, AFittedViewGivesTheSamePictureAgain) {
  const Mesh mesh = torus_mesh(60, 30, 3.0f, 0.5f);
  RenderOptions options;
  options.width = options.height = 64;
  const View fitted = fit_view(mesh, options.view, options);
  ASSERT_TRUE(fitted.target && fitted.distance);
  RenderOptions again = options;
  again.view = fitted;
  EXPECT_EQ(render(mesh, again)->rgb, render(mesh, options)->rgb);
  EXPECT_EQ(fit_view(torus_mesh(60, 30, 1.0f, 0.5f), fitted, options), fitted) << "whatever the model";
}

TEST(Render, DrawsFromWithinAndFromBehind) {
  const Mesh mesh = torus_mesh(60, 30, 3.0f, 0.5f);
  RenderOptions options;
  options.width = options.height = 32;
  options.view = View::from(0, 0);
  const auto picture = [&](const glm::dvec3& target, double distance) {
    options.view.target = target;
    options.view.distance = distance;
    const auto image = render(mesh, options);
    EXPECT_TRUE(image.ok()) << image.status();
    return image.ok() ? image->rgb : std::vector<std::uint8_t>();
  };
  const std::vector<std::uint8_t> background = render(Mesh(), options)->rgb;
  ASSERT_EQ(background.size(), 3u * 32 * 32);
  // The camera looks along -z, on whose axis the tube lies at z = 3 and at z = -3.
  EXPECT_NE(picture({0, 0, 2}, 4.0), background) << "from before the model";
  // From within the tube, its wall has its back to the camera, but the tube's other side is in sight.
  const std::vector<std::uint8_t> within = picture({0, 0, 3}, 1e-6);
  EXPECT_NE(within, background) << "from within the tube";
  EXPECT_EQ(within.size(), background.size());
  EXPECT_EQ(picture({0, 0, -3.2}, 1e-6), background) << "within the tube, with nothing but its back in sight";
  EXPECT_EQ(picture({0, 0, -1e6}, 1.0), background) << "the model is behind the camera";
  EXPECT_EQ(picture({0, 0, 0}, 1e20), background) << "the model is smaller than a sample";
}

TEST(ViewFile, KeepsAView) {
  const TemporaryDirectory directory;
  const std::string path = directory.path("view.json");
  EXPECT_EQ(*read_view_file(path), std::nullopt);
  View view = View::from(30, 40);
  view.target = {0.1, -2, 3e-7};
  view.distance = 1.0 / 3;
  view.field_of_view = 50;
  ASSERT_TRUE(write_view_file(path, view).ok());
  EXPECT_EQ(**read_view_file(path), view);
}

TEST(ViewFile, DamageIsToldWithTheFilesName) {
  const TemporaryDirectory directory;
  const std::string good =
      R"({"target": [0, 0, 0], "distance": 5, "direction": [0, 0, -1], "up": [0, 1, 0], "field_of_view": 28})";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  ASSERT_TRUE(read_view_file(write_file(directory.path("good"), good)).ok());
  const struct {
    std::string text, part;
  } kBad[] = {{"", "not a view"},
              {"{\"target\": [0,", "not a view"},
              {"[]", "not a view"},
              {"{}", "target is missing"},
              {with("distance", "distanse"), "did you mean \"distance\""},
              {with("\"up\": [0, 1, 0], ", ""), "up is missing"},
              {with("5", "\"5\""), "distance: expected a finite number"},
              {with("5", "-5"), "distance = -5: expected a length above 0"},
              {with("28", "180"), "within [1, 150]"},
              {with("[0, 0, 0]", "[0, 0]"), "target: expected 3 finite numbers"},
              {with("[0, 1, 0]", "[0, 0, 2]"), "not parallel"},
              {with("[0, 0, -1]", "[0, 0, 0]"), "any length but 0"}};
  for (const auto& [text, part] : kBad) {
    const auto view = read_view_file(write_file(directory.path("bad.json"), text));
    ASSERT_FALSE(view.ok()) << text;
    const std::string message(view.status().message());
    EXPECT_NE(message.find("bad.json: "), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Rasterizer, ShowsTheNearestFrontFace) {
  const Mesh mesh = torus_mesh(200, 100, 1.0f, 0.5f);
  const Camera camera = fit_camera(mesh.positions, View::from(0, 90), 1);
  const Visibility seen = rasterize(mesh, camera, 301, 301);
  // The camera looks from above at a ring with a hole. The ring's crest is nearest, and its normal there points towards
  // the viewer.
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
  // All vertices lie in one place.
  mesh = torus_mesh(8, 8, 0.0f, 0.0f);
  EXPECT_TRUE(render(mesh, {}).ok());
}

}  // namespace
}  // namespace isofield
