// Guesses which edits of a scene a modeller is likely to make next, considering only edits that need other kernels.
#pragma once

#include <vector>

#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::engine {

// Returns copies of the scene, each of which adds one of the things that most models are made of: a box, a cylinder, a
// difference or a gradient blend. `tape` is the scene's own tape. The places of added nodes do not matter as long as
// the surface crosses them. A scene of signed fields gets no gradient blend.
std::vector<v1::Scene> likely_edits(const v1::Scene& scene, const blobtree::Tape& tape);

}  // namespace isofield::engine
