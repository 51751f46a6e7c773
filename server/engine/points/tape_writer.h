// Writes a tape as GLSL, for a kernel that is made for tapes of one structure: straight-line code that names the places
// of the tape's records, and reads their numbers from there.
#pragma once

#include <string>

#include "blobtree/tape/tape.h"
#include "engine/kernels/kernel_cache.h"

namespace isofield::engine {

// Returns true if the tape's parameters fit into uniform buffers, from which written code reads them.
bool is_writable(const blobtree::Tape& tape);

// Returns the text of Field evaluate_tape(vec3 p), for shaders/tape_points.comp. The text applies operators in the
// order of the interpreter and by the same functions. Tapes of one structure give the same text, whatever their
// parameters.
std::string write_tape(const blobtree::Tape& tape);

// Returns the text of macros that define the specialisation constants of kernel_constants.h.
std::string write_definitions(const KernelKind& kind, bool with_gradient);

}  // namespace isofield::engine
