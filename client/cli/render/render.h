#pragma once

#include <absl/status/statusor.h>

#include "isofield/client.h"
#include "render/camera.h"
#include "render/image.h"

namespace isofield {

// The size of a picture and the place from which it is taken.
struct RenderOptions {
  // Pixels, each within [16, 8192].
  int width = 1280;
  int height = 960;
  View view;
};

// Draws a picture of a mesh, with smooth normals, three lights, ambient occlusion and 2 x 2 samples a pixel. The same
// mesh gives the same picture. An empty mesh gives the background.
// INVALID_ARGUMENT: the mesh has no normals, or the width or height is out of its range.
absl::StatusOr<Image> render(const Mesh& mesh, const RenderOptions& options);

// Returns the view with the target and distance that render() chooses if the view states none. It gives the same
// picture of this mesh, and a picture of another mesh from the same place. For an empty mesh they stay open.
View fit_view(const Mesh& mesh, const View& view, const RenderOptions& options);

}  // namespace isofield
