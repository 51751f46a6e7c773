#include "render/render.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>

#include "render/bands.h"
#include "render/occlusion.h"
#include "render/rasterizer.h"
#include "render/unit_vector.h"

namespace isofield {
namespace {

// Samples along each edge of a pixel.
constexpr int kSupersampling = 2;

// These colours are in linear light.
constexpr glm::vec3 kSurface = {0.72f, 0.21f, 0.075f};
constexpr glm::vec3 kBackgroundTop = {0.93f, 0.945f, 0.965f};
constexpr glm::vec3 kBackgroundBottom = {0.52f, 0.58f, 0.66f};
constexpr glm::vec3 kSkyLight = {0.46f, 0.52f, 0.62f};
constexpr glm::vec3 kGroundLight = {0.17f, 0.14f, 0.13f};

// A light. Directions lead to the light in camera space, so lights turn with the viewer and every view is lit alike.
struct Light {
  glm::vec3 direction;
  glm::vec3 color;
};
const std::array<Light, 3> kLights = {{{unit_vector({-0.5f, 0.75f, 0.62f}), {1.05f, 1.00f, 0.92f}},
                                       {unit_vector({0.85f, 0.10f, 0.45f}), {0.22f, 0.26f, 0.34f}},
                                       {unit_vector({0.25f, 0.55f, -0.85f}), {0.50f, 0.54f, 0.60f}}}};
// The part of the background's colour in that of the farthest point of the model; the nearest point has none of it.
constexpr float kHaze = 0.15f;
// The reach of occlusion as a part of the model's extent.
constexpr float kOcclusionReach = 0.06f;

glm::vec3 background(int y, int height) {
  const float t = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
  return glm::mix(kBackgroundTop, kBackgroundBottom, t * t);
}

float power32(float x) {
  for (int i = 0; i < 5; ++i) x *= x;
  return x;
}

// Returns the colour of the surface in linear light. `view` is the unit vector from the surface to the camera; it is in
// camera space, like `normal`. `sky_seen` is the part of the sky that the surface sees, within [0, 1].
glm::vec3 shade(const glm::vec3& normal, const glm::vec3& view, float sky_seen) {
  glm::vec3 light = glm::mix(kGroundLight, kSkyLight, 0.5f + 0.5f * normal.y) * sky_seen;
  float glint = 0;
  for (const Light& source : kLights) {
    const float facing = glm::dot(normal, source.direction);
    if (facing <= 0) continue;
    light += source.color * (facing * (0.55f + 0.45f * sky_seen));
    glint += source.color.y * power32(std::max(0.0f, glm::dot(normal, unit_vector(source.direction + view))));
  }
  const float grazing = 1 - std::max(0.0f, glm::dot(normal, view));
  const float rim = grazing * grazing * grazing * 0.22f * sky_seen;
  const glm::vec3 white = {1, 1, 1};
  return kSurface * light * 0.9f + white * (0.16f * glint * sky_seen) + kSkyLight * rim;
}

// Converts linear light within [0, 1] to bytes of sRGB, by a table whose steps are finer than those of a byte.
class SrgbTable {
 public:
  SrgbTable() {
    for (int i = 0; i <= kSteps; ++i) {
      const double linear = static_cast<double>(i) / kSteps;
      const double srgb = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      bytes_[i] = static_cast<std::uint8_t>(std::lround(255 * srgb));
    }
  }
  std::uint8_t operator()(float linear) const { return bytes_[std::lround(std::clamp(linear, 0.0f, 1.0f) * kSteps)]; }

 private:
  static constexpr int kSteps = 8192;
  std::array<std::uint8_t, kSteps + 1> bytes_;
};

// Returns every second sample of every second row. Occlusion is smooth, so it is estimated on these alone.
Visibility thin_out(const Visibility& seen) {
  Visibility out;
  out.width = seen.width / kSupersampling;
  out.height = seen.height / kSupersampling;
  out.inverse_depth.reserve(seen.inverse_depth.size() / (kSupersampling * kSupersampling));
  out.normals.reserve(seen.normals.size() / (kSupersampling * kSupersampling));
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const std::size_t sample = static_cast<std::size_t>(y) * kSupersampling * static_cast<std::size_t>(seen.width) +
                                 static_cast<std::size_t>(x) * kSupersampling;
      out.inverse_depth.push_back(seen.inverse_depth[sample]);
      out.normals.push_back(seen.normals[2 * sample]);
      out.normals.push_back(seen.normals[2 * sample + 1]);
    }
  }
  return out;
}

glm::vec3 shade_sample(const Visibility& seen, std::size_t sample, int x, int y, const Camera& camera, float sky_seen,
                       const glm::vec3& behind) {
  const float inverse_depth = seen.inverse_depth[sample];
  if (inverse_depth == 0) return behind;
  const float to_x = (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(seen.width) - 1) * camera.tan_x;
  const float to_y = (1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(seen.height)) * camera.tan_y;
  const glm::vec3 color = shade(seen.normal(sample), unit_vector({-to_x, -to_y, 1}), sky_seen);
  const float away = (1 / inverse_depth - camera.near) / std::max(camera.far - camera.near, 1e-30f);
  return glm::mix(color, behind, kHaze * std::clamp(away, 0.0f, 1.0f) * std::clamp(away, 0.0f, 1.0f));
}

Image paint(const Visibility& seen, const std::vector<float>& sky_seen, const Camera& camera, int width, int height) {
  const SrgbTable srgb;
  Image image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for_each_band(height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const glm::vec3 behind = background(y, height);
      std::uint8_t* out = &image.rgb[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      for (int x = 0; x < width; ++x) {
        const float sky = sky_seen.empty() ? 1 : sky_seen[static_cast<std::size_t>(y) * width + x];
        std::array<int, 3> sum = {0, 0, 0};
        for (int i = 0; i < kSupersampling * kSupersampling; ++i) {
          const int sx = x * kSupersampling + i % kSupersampling;
          const int sy = y * kSupersampling + i / kSupersampling;
          const std::size_t sample =
              static_cast<std::size_t>(sy) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(sx);
          const glm::vec3 color =
              seen.inverse_depth.empty() ? behind : shade_sample(seen, sample, sx, sy, camera, sky, behind);
          // The samples are averaged as bytes of sRGB, which keeps edges between light and dark even to the eye.
          sum[0] += srgb(color.x);
          sum[1] += srgb(color.y);
          sum[2] += srgb(color.z);
        }
        for (const int channel : sum) {
          *out++ = static_cast<std::uint8_t>((channel + kSupersampling) / (kSupersampling * kSupersampling));
        }
      }
    }
  });
  return image;
}

// Returns the decimal number with the fewest digits that rounds to this float32, as a person would write it.
double decimal(float value) {
  char digits[32];
  double number = value;
  std::from_chars(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr, number);
  return number;
}

}  // namespace

absl::StatusOr<Image> render(const Mesh& mesh, const RenderOptions& options) {
  for (const int size : {options.width, options.height}) {
    if (size < 16 || size > 8192) {
      return absl::InvalidArgumentError(absl::StrCat("picture size ", size, "; expected within [16, 8192] pixels"));
    }
  }
  if (mesh.triangles.empty()) return paint(Visibility(), {}, Camera(), options.width, options.height);
  if (mesh.normals.size() != mesh.positions.size()) return absl::InvalidArgumentError("the mesh has no normals");
  const Camera camera = fit_camera(mesh.positions, options.view, static_cast<double>(options.width) / options.height);
  const Visibility seen = rasterize(mesh, camera, kSupersampling * options.width, kSupersampling * options.height);
  // The picture's extent at the model's middle; a model that fills the picture has about the same extent.
  const float extent = (camera.near + camera.far) * std::min(camera.tan_x, camera.tan_y);
  const std::vector<float> sky_seen = ambient_visibility(thin_out(seen), camera, kOcclusionReach * extent);
  return paint(seen, sky_seen, camera, options.width, options.height);
}

View fit_view(const Mesh& mesh, const View& view, const RenderOptions& options) {
  View fitted = view;
  if (mesh.positions.empty()) return fitted;
  const Camera camera = fit_camera(mesh.positions, view, static_cast<double>(options.width) / options.height);
  if (!fitted.target) fitted.target = {decimal(camera.target.x), decimal(camera.target.y), decimal(camera.target.z)};
  if (!fitted.distance) fitted.distance = decimal(camera.distance);
  return fitted;
}

}  // namespace isofield
