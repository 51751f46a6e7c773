// Tests the limits of the elements of a mesh's part.
#include "engine/mesh/element_pass.h"

#include <gtest/gtest.h>

#include <string>

namespace isofield::engine {
namespace {

TEST(CheckElements, AdmitsWhatBuffersHoldAndTellsTheLimits) {
  constexpr std::uint64_t kBytes = 4800;  // 400 vertices or 300 quads
  const MeshRequest by_size{.cell_size = 0.25}, by_resolution{.cell_size = 0.25, .resolution = 64};
  EXPECT_TRUE(check_elements(by_size, 400, 300, kBytes).ok());
  const absl::Status vertices = check_elements(by_size, 401, 10, kBytes);
  EXPECT_EQ(vertices, absl::ResourceExhaustedError(
                          "cell_size = 0.25 makes 401 vertices and 10 quads at once; this device holds 400 and 300; "
                          "ask for larger cells, or a part by its bounds"));
  const absl::Status quads = check_elements(by_resolution, 10, 301, kBytes);
  EXPECT_EQ(quads.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(std::string(quads.message()).find("resolution = 64 makes 10 vertices and 301 quads"), 0u) << quads;
}

}  // namespace
}  // namespace isofield::engine
