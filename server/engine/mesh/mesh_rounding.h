// Bounds the rounding errors of a mesh's samples. Rounding may put a sample on the wrong side of the surface; then the
// field at a point a little beside the lattice point decides the side (shaders/lib/mesh_constants.glsl has the rule).
#pragma once

#include "blobtree/cull/lattice.h"
#include "blobtree/tape/tape.h"

namespace isofield::engine {

struct MeshRounding {
  // The distance of the point beside; model units. It is a thousandth of a cell, or more if rounding errors are that
  // large, and at most a tenth of a cell.
  double shift;
  double length;  // how far rounding of coordinates moves a point, model units
  double value;   // how far rounding of values changes the field
  double near;    // rounding may decide the side of a sample only if it differs from iso by no more than this

  bool operator==(const MeshRounding&) const = default;
};
// The results change in steps, so that small edits of a scene leave them as they are.
MeshRounding mesh_rounding(const blobtree::Tape& tape, const blobtree::Lattice& lattice, double iso);

}  // namespace isofield::engine
