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

// A picture of the whole mesh: smooth normals, three lights, ambient occlusion, 2 x 2 samples a pixel. The same mesh
// gives the same picture. An empty mesh gives the background.
// INVALID_ARGUMENT: a mesh without normals, or an option out of its range.
absl::StatusOr<Image> render(const Mesh& mesh, const RenderOptions& options);

}  // namespace isofield
