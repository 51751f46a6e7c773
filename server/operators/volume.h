// The `volume` representation of an operator, [G] section 4.3: values and partials at n^3 nodes over f1 and f2 within
// [0, 1] and theta within [0, pi/4], interpolated trilinearly; in double precision. Cells on the diagonal f1 = f2,
// where max and folds break, are two prisms, linear on either side: the largest error is then 2.5 times less at 16^3.
#pragma once

#include <functional>

#include "operators/gradient_blend.h"
#include "operators/sampled.h"

namespace isofield::operators {

struct VolumeNode {
  double g = 0, g1 = 0, g2 = 0, gt = 0;  // value, d/df1, d/df2, d/dtheta
};
// At node (i, j, k) of (f1, f2, theta).
using VolumeNodes = std::function<VolumeNode(int i, int j, int k)>;

// Node by node, made when asked for: a volume whole would take minutes.
VolumeNodes gradient_nodes(const Silhouette& silhouette, int size);
// Partials by central differences, one-sided at the ends. `samples` must outlive the result.
VolumeNodes sampled_nodes(const SampledVolume& samples);

// How an operator goes on where a field is above 1 and the nodes end.
enum class Continuation {
  kAboutBoundary,  // homogeneous about (t/2, t/2), as the gradient blend is
  kAboutOrigin,    // g(f) = m g(f/m), m = max(f1, f2)
};

// f1, f2 >= 0, theta within [0, pi/4]. First partials are the interpolated ones, second partials are the slopes of
// their interpolation, the mixed one the mean of two. Where a field is 0 the other comes out untouched.
Blend volume_blend(double f1, double f2, double theta, int size, const VolumeNodes& nodes, Continuation continuation);

}  // namespace isofield::operators
