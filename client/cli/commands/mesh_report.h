#pragma once

#include <string>
#include <vector>

#include "isofield/v1/mesh_service.pb.h"

namespace isofield {

// Says what determined the cells of a mesh: an option or, without one, the server. Hints name the option.
enum class CellsBy { kServer, kCell, kResolution };

// Returns a sentence about each doubtful property of a mesh, such as cells that are too coarse or an empty surface.
std::vector<std::string> mesh_warnings(const v1::MeshSummary& summary, CellsBy cells_by);

// Returns the counts of bodies and voids, such as "2 bodies, 1 void, " or "1 body (2 bodies left out), ". The text is
// empty if the server did not count them.
std::string shells_clause(const v1::MeshSummary& summary);

// Prints each warning as a line on the standard error.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace isofield
