// The device of the GPU tests: opened once, under the validation layer. One validation message fails the run.
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

// How many random scenes of each kind a test takes; two where ISOFIELD_TESTS_FEW_SCENES is set, since every kind of
// scene has kernels of its own to compile.
std::uint64_t scene_count(std::uint64_t many);

// Whether ISOFIELD_TESTS_FEW_KERNELS is set: on drivers that take seconds to compile one, tests of every operator take
// two of the operators in all their forms, and the others as unions.
bool few_kernels();

// Read, compiled and uploaded; the process ends where that is refused.
engine::SceneLease resident(const v1::Scene& scene);

}  // namespace isofield::gpu_test
