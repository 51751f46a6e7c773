#pragma once

#include <string>
#include <vector>

#include "isofield/v1/mesh_service.pb.h"

namespace isofield {

// How the cells of a mesh were asked for, as hints name it.
enum class CellsBy { kServer, kCell, kResolution };

// What is doubtful about a mesh: cells that are too coarse, an empty surface. A sentence each.
std::vector<std::string> mesh_warnings(const v1::MeshSummary& summary, CellsBy cells_by);

// Such as "2 bodies, 1 void, " or "1 body (2 bodies left out), "; empty where the server did not count.
std::string shells_clause(const v1::MeshSummary& summary);

// One line each on the standard error.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace isofield
