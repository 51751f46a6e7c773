// The buffers that the device reads a tape's parameters from. Each kind of primitive and of operator lays its own
// records out, and its .glsl reads them.
#pragma once

#include <vector>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

struct ParameterBuffers {
  std::vector<Float4> leaves;      // records of record_size(operand) vec4s
  std::vector<Float4> operations;  // records of operation_record_size vec4s
  std::vector<Float4> tables;      // cubic cells of silhouettes, openings and curves
};

// Never empty buffers: a device binding needs a byte to bind to.
ParameterBuffers lay_out(const Tape& tape);
// All but the leaves, which stay empty.
ParameterBuffers lay_out_operations(const Tape& tape);

}  // namespace isofield::blobtree
