// Compiles tape_points.comp at run time with one tape written as GLSL, for small scenes that are evaluated often.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isofield::shaders {

// Returns the SPIR-V of the kernel. `definitions` holds macros, among them WITH_GRADIENT and the constants of
// codes.glsl. `tape` is GLSL that defines Field evaluate_tape(vec3 p) with the functions of lib/. INTERNAL: the text
// does not compile; the message is the compiler's. Thread-safe.
absl::StatusOr<std::vector<std::uint32_t>> compile_tape(const std::string& definitions, std::string_view tape);

// A number that changes with the version of glslang and with any embedded text, for the keys of kernels that are kept
// on disk.
std::uint64_t compiler_version();

// The FNV-1a hash of a text. `from` is the hash of the text before it, if there is one.
std::uint64_t hash_of(std::string_view text, std::uint64_t from = 0xcbf29ce484222325u);

}  // namespace isofield::shaders
