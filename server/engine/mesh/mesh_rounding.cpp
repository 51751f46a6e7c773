#include "engine/mesh/mesh_rounding.h"

#include <algorithm>
#include <cmath>

namespace isofield::engine {
namespace {

using operators::Opcode;

// Half a unit in the last place of float32, as a part of the number.
constexpr double kUnit = 0x1p-24;
// The number of roundings that add up between a lattice point's number and its distance from a placed shape: those of
// the spacing, the point, the anchor and a rotation.
constexpr double kRoundings = 4;
// The largest rounding error of a field of size 1; primitives and blends keep within it.
constexpr double kValueRounding = 1e-6;
// The largest slope of a positive primitive, times its range: (1 - R0) |w'(r)| is at most this, at r^2 = 1/5.
constexpr double kSteepest = 0.94;
// The limits of the shift, as parts of a cell. Less would do for most scenes; more makes slivers where a crease passes
// a lattice point.
constexpr double kLeastShift = 0.001, kMostShift = 0.1;
// The shift is this many times as long as rounding moves points or values, so that the value at the point beside tells
// the side.
constexpr double kShiftPerLength = 4, kShiftPerValue = 10;

// Rounds up to the next of four steps an octave, so that small edits of a scene change nothing.
double stepped(double x) {
  return std::exp2(std::ceil(4 * std::log2(x)) / 4);
}

double reach_of(const blobtree::Box& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                   std::abs(box.max.y), std::abs(box.max.z)});
}

// Returns the largest coordinate that the leaf's field is computed from.
double reach_of(const blobtree::Leaf& leaf) {
  const blobtree::dvec3& anchor = leaf.domain.anchor;
  return reach_of(leaf.support.is_bounded() ? leaf.support : blobtree::Box{anchor, anchor});
}

double slope_of(const blobtree::Leaf& leaf) {
  return leaf.domain.stretch * (leaf.law == operators::Law::kSigned ? leaf.per_distance : kSteepest / leaf.range);
}

// Returns the least slope of any primitive; the slope of a primitive is the largest that its field has.
double least_slope_of(const blobtree::Tape& tape) {
  double slope = 1e30;
  for (const blobtree::Leaf& leaf : tape.leaves) slope = std::min(slope, slope_of(leaf));
  return slope;
}

// Returns about the largest slope of the scene's field.
double most_slope_of(const blobtree::Tape& tape) {
  double slope = 1e-30;
  for (const blobtree::Leaf& leaf : tape.leaves) slope = std::max(slope, slope_of(leaf));
  double converted = 1;
  for (const blobtree::Operation& o : tape.operations) {
    if (o.op == Opcode::kLinear) converted = std::max(converted, std::abs(o.factor));
    if (o.op == Opcode::kSoften) converted = std::max(converted, kSteepest / o.range);
  }
  return slope * converted;
}

// Returns the size of the largest values that are rounded on the way to the root.
double value_of(const blobtree::Tape& tape, double iso) {
  double value = tape.law == operators::Law::kSigned ? std::abs(iso) : 1;
  for (const blobtree::Operation& o : tape.operations) {
    if (o.op == Opcode::kLinear) value = std::max(value, std::abs(o.offset));
  }
  return value;
}

}  // namespace

MeshRounding mesh_rounding(const blobtree::Tape& tape, const blobtree::Lattice& lattice, double iso) {
  const double cell = lattice.spacing.x;
  const blobtree::dvec3 size{lattice.cells[0] * cell, lattice.cells[1] * cell, lattice.cells[2] * cell};
  double reach = reach_of({lattice.origin, lattice.origin + size});
  for (const blobtree::Leaf& leaf : tape.leaves) reach = std::max(reach, reach_of(leaf));
  MeshRounding rounding;
  rounding.length = std::min(kRoundings * kUnit * stepped(reach), kMostShift * cell / kShiftPerLength);
  rounding.value = kValueRounding * value_of(tape, iso);
  const double for_value = stepped(kShiftPerValue * rounding.value / least_slope_of(tape) + 1e-30);
  rounding.shift =
      std::max(kShiftPerLength * rounding.length, std::clamp(for_value, kLeastShift * cell, kMostShift * cell));
  rounding.near = rounding.value + stepped(most_slope_of(tape)) * rounding.length;
  return rounding;
}

}  // namespace isofield::engine
