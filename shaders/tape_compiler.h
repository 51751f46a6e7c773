// Compiles tape_points.comp with a tape that is written out.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isofield::shaders {

// `definitions`: macros, WITH_GRADIENT and the constants of codes.glsl among them. `tape`: GLSL that defines
// Field evaluate_tape(vec3 p) by what lib/ has. INTERNAL: it does not compile; the message is the compiler's.
// Thread-safe.
absl::StatusOr<std::vector<std::uint32_t>> compile_tape(const std::string& definitions, std::string_view tape);

// Changes where the compiler or a text that it reads does.
std::uint64_t compiler_version();

// FNV-1a.
std::uint64_t hash_of(std::string_view text, std::uint64_t from = 0xcbf29ce484222325u);

}  // namespace isofield::shaders
