// Writes a tape out as GLSL: straight-line code that names the places of its records, and reads what lies there.
#pragma once

#include <string>

#include "blobtree/tape/tape.h"
#include "engine/kernels/kernel_cache.h"

namespace isofield::engine {

// Whether its parameters lie where written code reads them: in uniform buffers.
bool is_writable(const blobtree::Tape& tape);

// Field evaluate_tape(vec3 p), for shaders/tape_points.comp: operators are applied in the order of the interpreter, by
// the same functions. Tapes of one structure, whatever their parameters, give the same text.
std::string write_tape(const blobtree::Tape& tape);

// The specialisation constants of kernel_constants.h as macros.
std::string write_definitions(const KernelKind& kind, bool with_gradient);

}  // namespace isofield::engine
