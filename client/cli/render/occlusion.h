#pragma once

#include <vector>

#include "render/camera.h"
#include "render/rasterizer.h"

namespace isofield {

// Estimates how much of the sky each sample of a picture sees, within [0, 1], from its neighbourhood in the picture:
// M. McGuire et al., "The Alchemy Screen-Space Ambient Obscurance Algorithm" (HPG 2011). It uses a fixed pattern, not
// random numbers, so the same picture gives the same result. `radius` is the reach in model units.
std::vector<float> ambient_visibility(const Visibility& seen, const Camera& camera, float radius);

}  // namespace isofield
