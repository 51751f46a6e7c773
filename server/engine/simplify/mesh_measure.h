// Numbers of a closed mesh.
#pragma once

#include "blobtree/tape/tape.h"
#include "engine/mesh/mesher.h"

namespace isofield::engine {

// Model units, their squares and cubes.
struct MeshMeasures {
  double area = 0;
  double volume = 0;         // of what the mesh encloses
  blobtree::dvec3 centroid;  // of that volume; 0, 0, 0 where it is 0
  blobtree::Box bounds;      // of the vertices; empty where there are none
};

// In double, by the divergence theorem.
MeshMeasures measure(const Mesh& mesh);

}  // namespace isofield::engine
