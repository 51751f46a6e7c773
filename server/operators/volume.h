// volume_blend() evaluates the `volume` representation of an operator, [G] section 4.3, in double precision: values and
// partials at n^3 nodes over f1 and f2 within [0, 1] and theta within [0, pi/4], interpolated trilinearly. A cell on
// the diagonal f1 = f2, where max and folds have an edge, is two prisms, linear on either side, because the largest
// error is then far less.
#pragma once

#include <functional>

#include "operators/gradient_blend.h"
#include "operators/sampled.h"

namespace isofield::operators {

struct VolumeNode {
  double g = 0, g1 = 0, g2 = 0, gt = 0;  // value, d/df1, d/df2, d/dtheta
};
// Returns the node (i, j, k) of (f1, f2, theta).
using VolumeNodes = std::function<VolumeNode(int i, int j, int k)>;

// Returns the nodes of a gradient blend. Each node is computed when asked for, because a whole volume would take
// minutes.
VolumeNodes gradient_nodes(const Silhouette& silhouette, int size);
// Returns the nodes of a sampled operator. Its partials are central differences, one-sided at the ends. `samples` must
// outlive the result.
VolumeNodes sampled_nodes(const SampledVolume& samples);

// Continuation says how an operator goes on where a field is above 1, beyond the nodes.
enum class Continuation {
  kAboutBoundary,  // homogeneous about (t/2, t/2), as the gradient blend is
  kAboutOrigin,    // g(f) = m g(f/m), m = max(f1, f2)
};

// Returns the operator at f1, f2 >= 0 and theta within [0, pi/4]. First partials are the interpolated ones. Second
// partials are the slopes of their interpolation, and the mixed one is the mean of two. If one field is 0, the other
// comes out untouched.
Blend volume_blend(double f1, double f2, double theta, int size, const VolumeNodes& nodes, Continuation continuation);

}  // namespace isofield::operators
