// Gives the GPU tests their device, which is opened once, under the validation layer. One validation message fails the
// run.
#pragma once

#include "base/workers.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/residency/resident_scene.h"
#include "gpu/device.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::gpu_test {

gpu::Device& device();
engine::KernelCache& kernels();
engine::VolumeCache& volumes();
base::Workers& workers();

// Returns how many random scenes of each kind a test takes: `many`, or two if ISOFIELD_TESTS_FEW_SCENES is set, since
// every kind of scene has kernels of its own to compile.
std::uint64_t scene_count(std::uint64_t many);

// Returns whether ISOFIELD_TESTS_FEW_KERNELS is set, for drivers that take seconds to compile a kernel. The tests of
// every operator then take two of the operators in all their forms, and the others as unions.
bool few_kernels();

// Reads, compiles and uploads a scene. A refusal ends the process.
engine::SceneLease resident(const v1::Scene& scene);

}  // namespace isofield::gpu_test
