// Functions of one variable as piecewise cubics: the `profile` representation of an operator, a few KiB instead of a
// volume. Cubic Hermite cells keep value and slope continuous, and exact at the nodes.
#pragma once

#include <array>
#include <vector>

#include "operators/derivatives.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// Coefficients of c[0] + c[1] s + c[2] s^2 + c[3] s^3; s is 0 where the cell starts and, unless something else is said,
// 1 where it ends.
using CubicCell = std::array<float, 4>;
using ProfileTable = std::vector<CubicCell>;

// Numbers of cells. Measured maximal errors of the device's g against exact arithmetic are in tests/gpu.
inline constexpr int kSilhouetteCells = 512;  // z of Grading within [0, 1]

// A bulge's profile q(u) ends at its fold, u = 1, like a square root, entirely so at K = 1. Its cells therefore lie at
// even steps of z = 1 - n (sqrt(e^2 + w) - e), w = 1 - u, in which it is smooth; e tells how far beyond the fold the
// root lies, and n = sqrt(e^2 + 1) + e lets z start at 0. A large e leaves the steps even in u.
struct Grading {
  double e;

  static Grading of(const Silhouette& silhouette);
  double n() const;
  // w at z, and -dw/dz.
  double w(double z) const;
  double slope(double z) const;
};

// One record (e, 0, 0, 0), then kSilhouetteCells cells; of a silhouette that is not symmetric the same again for the
// second half.
ProfileTable silhouette_table(const Silhouette& silhouette);
// An opening over alpha within [0, pi]: one record, then cells.
//
// Ramps: record (origin, left, right, shift), the last an integer. The origin is alpha1 in float32; on either side of
// it the place of alpha is kFirstPlace plus left or right times its distance, and 1 where the ramp ends. The bits of a
// place, shifted to the right, number its cell, so that cells are narrow at the origin, where kappa^w of a small w
// rises within a hundredth of a ramp. They hold tan(theta), all that the operator needs, with s the place beyond the
// cell's start; the cells of the right ramp come first. tan(theta) is within 1e-7, its slope within 3e-6 of a ramp's
// steepest.
//
// Samples: record (step, rest, 1 / (step + rest), -cells). Cell i starts at i (step + rest), where a sample lies, so
// that it holds theta's own cubic; step has so few digits that i step is exact.
inline constexpr double kFirstPlace = 1.0 / 16;
inline constexpr int kRampOctaves = 4;
ProfileTable opening_table(const Opening& opening);
// Cells of one octave of a ramp's places.
int cells_per_octave(const Opening& opening);

// H of a functional blend: of each piece between two control points the record (x where it begins, 1 / its width, 0, 0),
// then its cell. Pieces as they are, since their widths may differ by any factor.
ProfileTable curve_table(const SampledCurve& curve);

// The least c with q(u) <= 1 + c u on [0, 1]: M(a, b) <= a + c b bounds the operator from above.
double silhouette_bound(const Silhouette& silhouette);

}  // namespace isofield::operators
