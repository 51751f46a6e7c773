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

// The options of the commands that need a mesh, and the request itself.
struct MeshFlags {
  std::string scene;
  std::optional<double> cell;
  std::optional<std::uint32_t> resolution;
  std::vector<double> bounds;  // x0, y0, z0, x1, y1, z1, or empty
  std::optional<double> iso, tolerance, simplify;
  bool omit_normals = false, largest_body = false, fill_voids = false;
  // Whether the mesh is to have Mesh::creases, where it has normals. No option: commands know what they draw or write.
  bool crease_normals = false;
  ImportFlags import;

  void add_to(Command command);
  // The request that the options make, without sending it.
  absl::StatusOr<v1::MeshRequest> message() const;
  // Sends the request, and shows a progress line on a terminal. `seconds` is the time from the request to the last
  // byte.
  absl::StatusOr<Mesh> request(const Context& context, Client& client, double& seconds) const;
  // Adds the flag's name where the server speaks of bounds, a cell size or a resolution.
  absl::Status explain(const absl::Status& refusal) const;
  CellsBy cells_by() const;
};

}  // namespace isofield
