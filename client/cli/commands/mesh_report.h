#pragma once

#include <string>
#include <vector>

#include "isofield/v1/mesh_service.pb.h"

namespace isofield {

// The way in which a command asked for the cells of a mesh; hints name the option.
enum class CellsBy { kServer, kCell, kResolution };

// Says what is doubtful about a mesh, such as cells that are too coarse or an empty surface, in a sentence each.
std::vector<std::string> mesh_warnings(const v1::MeshSummary& summary, CellsBy cells_by);

// Such as "2 bodies, 1 void, " or "1 body (2 bodies left out), "; empty where the server did not count.
std::string shells_clause(const v1::MeshSummary& summary);

// One line each on the standard error.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace isofield
