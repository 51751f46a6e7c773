// Private to this room: what a Pipeline holds.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/vulkan.h"

namespace isofield::gpu {

struct Pipeline::Impl {
  vk::raii::Pipeline pipeline;
};

}  // namespace isofield::gpu
