// Measures a closed mesh: its area, volume, centroid and bounds.
#pragma once

#include "blobtree/tape/tape.h"
#include "engine/mesh/mesher.h"

namespace isofield::engine {

// The unit is the model unit, its square for the area, and its cube for the volume.
struct MeshMeasures {
  double area = 0;
  double volume = 0;         // the volume that the mesh encloses
  blobtree::dvec3 centroid;  // the centroid of that volume; 0, 0, 0 if the volume is not above 0
  blobtree::Box bounds;      // the bounds of the vertices; empty if there are none
};

// Computes the measures in double, by the divergence theorem.
MeshMeasures measure(const Mesh& mesh);

}  // namespace isofield::engine
