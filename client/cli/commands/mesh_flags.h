#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "commands/command_line.h"
#include "commands/context.h"
#include "commands/import_flags.h"
#include "commands/mesh_report.h"

namespace isofield {

// The options of the commands that need a mesh. They also build the request and send it.
struct MeshFlags {
  std::string scene;
  std::optional<double> cell;
  std::optional<std::uint32_t> resolution;
  std::vector<double> bounds;  // x0, y0, z0, x1, y1, z1, or empty
  std::optional<double> iso, tolerance, simplify;
  bool omit_normals = false, largest_body = false, fill_voids = false;
  // True if the mesh should have Mesh::creases, provided it has normals. It is not an option: the command sets it,
  // since it knows what it draws or writes.
  bool crease_normals = false;
  ImportFlags import;

  void add_to(Command command);
  // Returns the request that the options describe, without sending it. It imports a file where one is named.
  absl::StatusOr<v1::MeshRequest> message() const;
  // Sends the request, and shows a progress line on a terminal. Sets `seconds` to the time from the request to the last
  // byte.
  absl::StatusOr<Mesh> request(const Context& context, Client& client, double& seconds) const;
  // Adds the option's name to an error in which the server speaks of missing bounds, a cell size or a resolution.
  absl::Status explain(const absl::Status& refusal) const;
  // Tells which option, if any, determines the size of the cells.
  CellsBy cells_by() const;
};

}  // namespace isofield
