#include "blobtree/tape/parameter_layout.h"

#include <algorithm>

#include "blobtree/primitives/falloff.h"
#include "operators/tables.h"

namespace isofield::blobtree {
namespace {

void write_frame(const Affine::LowerTriangle& l, Float4* out) {
  out[0] = {f32(l[0]), f32(l[1]), f32(l[2]), f32(l[3])};
  out[1] = {f32(l[4]), f32(l[5]), 0, 0};
}

void write_operation(const Operation& o, operators::Tables& tables, Float4* out) {
  if (o.frame) write_frame(*o.frame, out - o.frame_size());
  if (o.what) {
    const operators::Use use{o.operands, o.length, o.volume_slot};
    o.what->visit([&](const auto& kind) { kind.write(use, tables, out); });
  } else if (o.op == Opcode::kSoften) {
    out[0] = {f32((1 - kR0) / o.range), 0, 0, 0};
  } else {
    out[0] = {f32(o.factor), f32(o.offset), 0, 0};
  }
}

}  // namespace

ParameterBuffers lay_out(const Tape& tape) {
  ParameterBuffers buffers = lay_out_operations(tape);
  buffers.leaves.resize(std::max<std::size_t>(tape.leaf_records, 1));
  for (const Leaf& leaf : tape.leaves) write_leaf(leaf, &buffers.leaves[leaf.record]);
  return buffers;
}

ParameterBuffers lay_out_operations(const Tape& tape) {
  ParameterBuffers buffers;
  operators::Tables tables(buffers.tables);
  buffers.operations.resize(std::max<std::size_t>(tape.record_owners.size(), 1));
  for (const Operation& o : tape.operations) write_operation(o, tables, &buffers.operations[o.record]);
  if (buffers.tables.empty()) buffers.tables.resize(1);
  return buffers;
}

}  // namespace isofield::blobtree
