// A build tool that writes the constants and layouts that shaders share with C++ as GLSL (shaders/CMakeLists.txt).
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "blobtree/cull/lattice.h"
#include "blobtree/tape/window_packer.h"
#include "engine/kernels/bindings.h"
#include "engine/mesh/mesh_layout.h"
#include "operators/profile_table.h"

namespace {

using namespace isofield;

// Returns a macro's name: "mesh" and "SurfaceCases" make MESH_SURFACE_CASES.
std::string macro_of(const std::string& family, const std::string& name) {
  std::string macro;
  for (const char c : family) macro += static_cast<char>(std::toupper(c));
  for (const char c : name) {
    if (std::isupper(c)) macro += '_';
    macro += static_cast<char>(std::toupper(c));
  }
  return macro;
}

// Writes a macro and not a const, because an unused const stays in the compiled kernel.
void write_constant(const char* name, std::uint32_t value) {
  std::printf("#define %s %uu\n", name, value);
}

void write_bindings() {
#define ISOFIELD_BINDING(family, name, number) \
  std::printf("#define BINDING_%s %d\n", macro_of(#family, #name).c_str(), number);
  ISOFIELD_BINDINGS(ISOFIELD_BINDING)
#undef ISOFIELD_BINDING
  write_constant("LEAVES_ARE_UNIFORM", engine::kLeavesAreUniform);
  write_constant("OPERATIONS_ARE_UNIFORM", engine::kOperationsAreUniform);
  write_constant("TAPE_IS_UNIFORM", engine::kTapeIsUniform);
  write_constant("LOADS_ARE_SHARED", engine::kLoadsAreShared);
}

void write_sizes() {
  write_constant("BRICK_CELLS", blobtree::kBrickCells);
  // lib/bricks.glsl reads the members of Brick at these offsets.
  static_assert(offsetof(blobtree::Brick, tape_begin) == 12 && offsetof(blobtree::Brick, tape_count) == 16);
  write_constant("BRICK_WORDS", sizeof(blobtree::Brick) / sizeof(std::uint32_t));
  write_constant("WINDOW_SIZE", blobtree::kWindowSize);
  std::printf("#define SILHOUETTE_CELLS %d\n", operators::kSilhouetteCells);
}

// A member of MeshConstants and its declaration in GLSL. std430 gives a vec4 an offset that is a multiple of 16.
struct Member {
  const char* glsl;
  std::size_t offset;
};
constexpr Member kMembers[] = {
    {"vec4 origin", offsetof(engine::MeshConstants, origin)},  // w is the cell size
    {"uvec4 cells", offsetof(engine::MeshConstants, cells)},
    {"uint first", offsetof(engine::MeshConstants, first)},
    {"uint count", offsetof(engine::MeshConstants, count)},
    {"float iso", offsetof(engine::MeshConstants, iso)},
    {"uint flags", offsetof(engine::MeshConstants, flags)},
    {"float tolerance", offsetof(engine::MeshConstants, tolerance)},
    {"float shift", offsetof(engine::MeshConstants, shift)},
    {"float near", offsetof(engine::MeshConstants, near)},
    {"float value_room", offsetof(engine::MeshConstants, value_room)},
    {"float slope_room", offsetof(engine::MeshConstants, slope_room)},
    {"float just_inside", offsetof(engine::MeshConstants, just_inside)},
};
static_assert(offsetof(engine::MeshConstants, cell) == offsetof(engine::MeshConstants, origin) + 12);
static_assert(offsetof(engine::MeshConstants, origin) % 16 == 0 && offsetof(engine::MeshConstants, cells) % 16 == 0);
// Fails where a member is added to the struct but not to the table.
static_assert(sizeof(engine::MeshConstants) == kMembers[std::size(kMembers) - 1].offset + 4 &&
              sizeof(engine::MeshConstants) == 32 + 4 * (std::size(kMembers) - 2));
// 128 bytes of push constants are the least that every Vulkan device has.
static_assert(sizeof(engine::MeshConstants) <= 128);

void write_neighbours() {
  write_constant("NEIGHBOURS", engine::kNeighbours);
  write_constant("NO_BRICK", engine::kNoBrick);
  for (std::uint32_t n = 0; n < engine::kNeighbours; ++n) {
    bool is_below = false;
    std::string axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int step = engine::kNeighbourSteps[n][axis];
      is_below = is_below || step < 0;
      if (step != 0) axes += "XYZ"[axis];
    }
    write_constant(((is_below ? "BELOW_" : "ABOVE_") + axes).c_str(), n);
  }
}

void write_mesh() {
  std::printf("layout(push_constant) uniform Constants {\n");
  for (const Member& m : kMembers) std::printf("  layout(offset = %zu) %s;\n", m.offset, m.glsl);
  std::printf("};\n");
  write_constant("IS_CAPPED", engine::kIsCapped);
  write_constant("IS_SIGNED", engine::kIsSigned);
  write_constant("IS_LISTED", engine::kIsListed);
  write_constant("KNOWS_CROSSINGS", engine::kKnowsCrossings);
  write_constant("MAY_CREASE", engine::kMayCrease);
  write_constant("HAS_CREASES", engine::kHasCreases);
  write_neighbours();
  write_constant("OCTETS", engine::kOctets);
  write_constant("OCTET_BITS", engine::kOctetBits);
  write_constant("OWN_OCTETS", engine::kOwnOctets);
  write_constant("OCTET_CORNERS", engine::kOctetCorners);
  write_constant("CUT_02", engine::kCut02);
  write_constant("CUT_13", engine::kCut13);
  write_constant("CUT_FAN", engine::kCutFan);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what != "bindings" && what != "sizes" && what != "mesh") {
    return std::fputs("usage: isofield_write_layouts bindings|sizes|mesh\n", stderr), 2;
  }
  const std::string guard = macro_of(what, "Glsl");
  std::printf("// Written by shaders/generators/layouts.cpp.\n#ifndef %s\n#define %s\n", guard.c_str(), guard.c_str());
  if (what == "bindings") write_bindings();
  if (what == "sizes") write_sizes();
  if (what == "mesh") write_mesh();
  std::printf("#endif\n");
}
