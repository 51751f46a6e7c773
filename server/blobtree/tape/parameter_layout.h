// These functions fill the buffers that the device reads a tape's parameters from. Each kind of primitive and of
// operator lays its own records out, and its .glsl reads them.
#pragma once

#include <vector>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// ParameterBuffers are the buffers of one tape.
struct ParameterBuffers {
  std::vector<Float4> leaves;      // records of record_size(operand) vec4s
  std::vector<Float4> operations;  // records of operation_record_size vec4s
  std::vector<Float4> tables;      // cubic cells of silhouettes, openings and curves
};

// Returns buffers that are never empty, because a binding on the device needs a byte to bind to.
ParameterBuffers lay_out(const Tape& tape);
// Fills all buffers but that of the leaves, which stays empty.
ParameterBuffers lay_out_operations(const Tape& tape);

}  // namespace isofield::blobtree
