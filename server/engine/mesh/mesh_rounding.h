// How far rounding takes the samples of a mesh, and how far beside a lattice point the field decides for those that it
// may have put on the wrong side of the surface (shaders/lib/mesh_constants.glsl has the rule).
#pragma once

#include "blobtree/cull/lattice.h"
#include "blobtree/tape/tape.h"

namespace isofield::engine {

struct MeshRounding {
  double shift;   // model units; a thousandth of a cell, more where rounding takes points as far, a tenth at most
  double length;  // model units: how far the rounding of coordinates takes a point
  double value;   // how far the rounding of values takes the field
  double near;    // at most so far is the field from its value on the surface where rounding decides the side

  bool operator==(const MeshRounding&) const = default;
};
// The bounds change in steps, so that small edits of a scene leave them as they are.
MeshRounding mesh_rounding(const blobtree::Tape& tape, const blobtree::Lattice& lattice, double iso);

}  // namespace isofield::engine
