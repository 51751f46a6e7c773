#include "specialise.h"

#include <absl/strings/str_cat.h>
#include <spirv-tools/libspirv.h>

#include <spirv-tools/optimizer.hpp>
#include <string>
#include <unordered_map>

#include "tape_compiler.h"

namespace isofield::shaders {

absl::StatusOr<std::vector<std::uint32_t>> specialise(Spirv kernel, std::span<const std::uint32_t> constants) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (std::uint32_t i = 0; i < constants.size(); ++i) values[i] = {constants[i]};
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  std::string complaints;
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
    if (level <= SPV_MSG_ERROR) absl::StrAppend(&complaints, message, "\n");
  });
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // the build has validated it
  std::vector<std::uint32_t> specialised;
  if (!optimizer.Run(kernel.data(), kernel.size(), &specialised, options)) {
    return absl::InternalError(absl::StrCat("specialising a kernel: ", complaints));
  }
  return specialised;
}

std::uint64_t specialiser_version() {
  return hash_of(spvSoftwareVersionDetailsString());
}

}  // namespace isofield::shaders
