// These functions tabulate functions of one variable as piecewise cubics. Tables are the `profile` representation of an
// operator, which takes a few KiB instead of a volume. Cubic Hermite cells keep value and slope continuous, and exact
// at the nodes.
#pragma once

#include <array>
#include <vector>

#include "operators/derivatives.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// A CubicCell has the coefficients of c[0] + c[1] s + c[2] s^2 + c[3] s^3. s is 0 where the cell starts and, unless
// something else is said, 1 where it ends.
using CubicCell = std::array<float, 4>;
using ProfileTable = std::vector<CubicCell>;

// A silhouette has this many cells over z within [0, 1] (Grading). tests/gpu has the largest errors of the device's g
// against exact arithmetic.
inline constexpr int kSilhouetteCells = 512;

// Grading places the cells of a silhouette's profile. A bulge's profile q(u) ends at its fold, u = 1, like a square
// root, entirely so at K = 1. Its cells therefore lie at even steps of z = 1 - n (sqrt(e^2 + w) - e), w = 1 - u, in
// which it is smooth. e tells how far beyond the fold the root lies, and n = sqrt(e^2 + 1) + e lets z start at 0. A
// large e leaves the steps even in u.
struct Grading {
  double e;

  static Grading of(const Silhouette& silhouette);
  double n() const;
  // w() is w at z, and slope() is -dw/dz.
  double w(double z) const;
  double slope(double z) const;
};

// Returns one record (e, 0, 0, 0) and then kSilhouetteCells cells. A silhouette that is not symmetric has the same
// again for the second half.
ProfileTable silhouette_table(const Silhouette& silhouette);
// opening_table() returns the table of an opening over alpha within [0, pi]: one record, then cells.
//
// An opening with ramps has the record (origin, left, right, shift), the last an integer. The origin is alpha1 in
// float32. On either side of it the place of alpha is kFirstPlace plus left or right times its distance from the
// origin, and 1 where the ramp ends. The bits of a place, shifted to the right, number its cell, so that cells are
// narrow at the origin, where kappa^w of a small w rises within a hundredth of a ramp. The cells hold tan(theta), which
// is all that the operator needs; s is the place beyond the cell's start. The cells of the right ramp come first.
// tan(theta) is within 1e-7, and its slope within 3e-6 of the ramp's steepest slope.
//
// An opening with samples has the record (step, rest, 1 / (step + rest), -cells). Cell i starts at i (step + rest),
// where a sample lies, so that it holds theta's own cubic. `step` has so few digits that i step is exact.
inline constexpr double kFirstPlace = 1.0 / 16;
inline constexpr int kRampOctaves = 4;
ProfileTable opening_table(const Opening& opening);
// Returns how many cells one octave of a ramp's places has.
int cells_per_octave(const Opening& opening);

// Returns the table of H of a functional blend. Each piece between two control points has the record (x where it
// begins, 1 / its width, 0, 0) and then its cell. The pieces stay as they are, because their widths may differ by any
// factor.
ProfileTable curve_table(const SampledCurve& curve);

// Returns the least c with q(u) <= 1 + c u on [0, 1]. M(a, b) <= a + c b then bounds the operator from above.
double silhouette_bound(const Silhouette& silhouette);

}  // namespace isofield::operators
