#include "tape_compiler.h"

#include <absl/strings/str_cat.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <spirv-tools/optimizer.hpp>

namespace isofield::shaders {
namespace {

struct Text {
  std::string_view name, text;
};
constexpr Text kTexts[] = {
#include "library.inc"
};

std::string_view text_of(std::string_view name) {
  const auto found = std::find_if(std::begin(kTexts), std::end(kTexts), [&](const Text& t) { return t.name == name; });
  return found == std::end(kTexts) ? std::string_view() : found->text;
}

// Resolves includes: "tape.glsl" is the tape, and every other name is an embedded text.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(std::string_view tape) : tape_(tape) {}

  IncludeResult* includeLocal(const char* name, const char*, std::size_t) override {
    const std::string_view text = std::string_view(name) == "tape.glsl" ? tape_ : text_of(name);
    if (text.empty()) return nullptr;
    return new IncludeResult(name, text.data(), text.size(), nullptr);
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  std::string_view tape_;
};

// Keeps glslang's tables for as long as the process runs.
struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

}  // namespace

absl::StatusOr<std::vector<std::uint32_t>> compile_tape(const std::string& definitions, std::string_view tape) {
  static const Process process;
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  glslang::TShader shader(EShLangCompute);
  const std::string_view entry = text_of("tape_points.comp");
  const char* const text = entry.data();
  const int length = static_cast<int>(entry.size());
  shader.setStringsWithLengths(&text, &length, 1);
  shader.setPreamble(definitions.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  Includer includer(tape);
  if (!shader.parse(GetDefaultResources(), 450, false, kMessages, includer)) {
    return absl::InternalError(absl::StrCat("a written tape: ", shader.getInfoLog()));
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) {
    return absl::InternalError(absl::StrCat("a written tape: ", program.getInfoLog()));
  }
  std::vector<std::uint32_t> spirv;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), spirv);
  // Remove the code that the definitions switch off: glslang folds constant conditions but keeps the branches.
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass());
  std::vector<std::uint32_t> kept;
  if (!optimizer.Run(spirv.data(), spirv.size(), &kept)) {
    return absl::InternalError("a written tape: the optimizer refuses it");
  }
  return kept;
}

std::uint64_t compiler_version() {
  static const std::uint64_t version = [] {
    const glslang::Version v = glslang::GetVersion();
    std::uint64_t hash = hash_of(absl::StrCat(v.major, ".", v.minor, ".", v.patch));
    for (const Text& t : kTexts) hash = hash_of(t.text, hash);
    return hash;
  }();
  return version;
}

std::uint64_t hash_of(std::string_view text, std::uint64_t from) {
  for (const char c : text) from = (from ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return from;
}

}  // namespace isofield::shaders
