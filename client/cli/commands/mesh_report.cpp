#include "commands/mesh_report.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <cmath>
#include <cstdio>

namespace isofield {
namespace {

std::string count(std::uint64_t number, const char* one, const char* many) {
  return absl::StrCat(number, " ", number == 1 ? one : many);
}

std::string shells(std::uint64_t bodies, std::uint64_t voids) {
  if (bodies == 0 && voids > 0) return count(voids, "void", "voids");
  const std::string text = count(bodies, "body", "bodies");
  return voids == 0 ? text : absl::StrCat(text, ", ", count(voids, "void", "voids"));
}

// Returns a size with three digits for a message. It is rounded down, so that a cell of this size is no coarser than
// the one that is needed.
std::string rounded_down(double size) {
  const double unit = std::pow(10, std::floor(std::log10(size)) - 2);
  return absl::StrFormat("%g", std::floor(size / unit * (1 + 1e-12)) * unit);
}

std::string remedy(double cell, CellsBy cells_by) {
  switch (cells_by) {
    case CellsBy::kServer:
      return "the server allows no smaller cells for the whole scene (isofieldd --max-mesh-cells); mesh parts of it "
             "(--bounds)";
    case CellsBy::kCell:
      return absl::StrCat("try --cell ", rounded_down(cell));
    case CellsBy::kResolution:
      return absl::StrCat("try a higher --resolution, or --cell ", rounded_down(cell));
  }
  return "";
}

std::string thinness_warning(const v1::MeshSummary& summary, CellsBy cells_by) {
  const v1::ThinPrimitives& thin = summary.too_thin();
  std::string effect = "the mesh may be torn or lack parts";
  if (summary.triangles() == 0) {
    effect = "the mesh is empty";
  } else if (summary.has_bodies()) {
    effect = absl::StrCat("the mesh has ", shells(summary.bodies(), summary.voids()), " and may be torn or lack parts");
  }
  return absl::StrFormat(
      "cells of %g are too coarse for %s: %s, the thinnest, is %g across and needs cells of at most %s; %s; %s",
      summary.cell_size(), count(thin.primitives(), "primitive", "primitives"), thin.node(), thin.thickness(),
      rounded_down(thin.cell_size()), effect, remedy(thin.cell_size(), cells_by));
}

std::string sliver_warning(const v1::MeshSummary& summary) {
  const v1::Slivers& slivers = summary.slivers();
  const std::uint64_t all = slivers.bodies() + slivers.voids();
  std::string place;
  if (slivers.position_size() == 3) {
    place = absl::StrFormat(", such as the one near %s at (%g, %g, %g)", slivers.node(), slivers.position(0),
                            slivers.position(1), slivers.position(2));
  }
  return absl::StrCat(all, " of the mesh's ", shells(summary.bodies(), summary.voids()),
                      all == 1 ? " is a sliver" : " are slivers", ", thinner than half a cell", place,
                      ": the field hardly reaches the iso value there; --largest leaves out slivers that are bodies");
}

}  // namespace

std::vector<std::string> mesh_warnings(const v1::MeshSummary& summary, CellsBy cells_by) {
  std::vector<std::string> warnings;
  if (summary.has_too_thin()) {
    warnings.push_back(thinness_warning(summary, cells_by));
  } else if (summary.triangles() == 0) {
    warnings.push_back("the surface is empty");
  }
  if (summary.has_slivers()) warnings.push_back(sliver_warning(summary));
  return warnings;
}

std::string shells_clause(const v1::MeshSummary& summary) {
  if (!summary.has_bodies()) return "";
  std::string clause = shells(summary.bodies(), summary.voids());
  if (summary.dropped_bodies() > 0 || summary.dropped_voids() > 0) {
    absl::StrAppend(&clause, " (", shells(summary.dropped_bodies(), summary.dropped_voids()), " left out)");
  }
  return clause + ", ";
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) absl::FPrintF(stderr, "isofield: warning: %s\n", warning);
}

}  // namespace isofield
