// The buffers that the device reads a tape's parameters from. Layouts are mirrored in shaders/lib/leaves.glsl and
// shaders/lib/operators.glsl.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "blobtree/tape/tape.h"
#include "operators/profile_table.h"

namespace isofield::blobtree {

using Float4 = std::array<float, 4>;

struct ParameterBuffers {
  std::vector<Float4> leaves;      // records of leaf_record_size vec4s
  std::vector<Float4> operations;  // records of operation_record_size vec4s
  std::vector<Float4> tables;      // cubic cells of silhouettes, openings and curves
};

// Never empty buffers: a device binding needs a byte to bind to.
ParameterBuffers lay_out(const Tape& tape);
// All but the leaves, which stay empty.
ParameterBuffers lay_out_operations(const Tape& tape);

}  // namespace isofield::blobtree
