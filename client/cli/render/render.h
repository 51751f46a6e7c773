#pragma once

#include <absl/status/statusor.h>

#include "isofield/client.h"
#include "render/camera.h"
#include "render/image.h"

namespace isofield {

struct RenderOptions {
  // Pixels, each within [16, 8192].
  int width = 1280;
  int height = 960;
  View view;
};

// A picture of a mesh: smooth normals, three lights, ambient occlusion, 2 x 2 samples a pixel. The same mesh
// gives the same picture. An empty mesh gives the background.
// INVALID_ARGUMENT: a mesh without normals, or an option out of its range.
absl::StatusOr<Image> render(const Mesh& mesh, const RenderOptions& options);

// The view with its target and distance, as render() chooses them where it states none: with it the picture is the
// same, and of another mesh taken from the same place. An empty mesh leaves them out.
View fit_view(const Mesh& mesh, const View& view, const RenderOptions& options);

}  // namespace isofield
