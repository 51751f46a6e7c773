// What a modeler is likely to do to a scene next, as far as the kernels that it needs are concerned.
#pragma once

#include <vector>

#include "blobtree/scene.h"
#include "blobtree/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::engine {

// The scene with one more of what models are made of most: a box, a cylinder, a difference, a gradient blend. `tape` is
// the scene's own. Where they lie is of no account but that the surface crosses them. A scene of signed fields gets no
// gradient blend.
std::vector<v1::Scene> likely_edits(const v1::Scene& scene, const blobtree::Tape& tape);

}  // namespace isofield::engine
