// Guesses what a modeller will do to a scene next, as far as this needs other kernels.
#pragma once

#include <vector>

#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::engine {

// Copies of the scene, each with one more of what most models are made of: a box, a cylinder, a difference or a
// gradient blend. `tape` is the scene's own. The places of added nodes do not matter as long as the surface crosses
// them. A scene of signed fields gets no gradient blend.
std::vector<v1::Scene> likely_edits(const v1::Scene& scene, const blobtree::Tape& tape);

}  // namespace isofield::engine
