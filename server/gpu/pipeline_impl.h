// The content of a Pipeline. Only files in gpu/ may include this header, since it includes Vulkan.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/vulkan.h"

namespace isofield::gpu {

struct Pipeline::Impl {
  vk::raii::Pipeline pipeline;
};

}  // namespace isofield::gpu
