// Tests the numbers that are derived from a device, on made-up devices.
#include "gpu/device_profile.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "gpu/commands.h"

namespace isofield::gpu {
namespace {

DeviceProfile profile(const char* type, std::uint32_t subgroup_size, unsigned host_threads = 2) {
  return profile_of({.type = type, .subgroup_size = subgroup_size, .max_buffer_bytes = 1u << 27}, host_threads);
}

// These numbers were measured on lavapipe. Measure again before you change one.
TEST(DeviceProfile, LavapipeKeepsItsNumbers) {
  const DeviceProfile p = profile("cpu", 8);
  EXPECT_EQ(p.submission_work, 1u << 21);
  EXPECT_EQ(p.written_work, 1u << 22);
  EXPECT_EQ(p.written_instructions, 48u);
  EXPECT_EQ(p.written_heavy_instructions, 12u);
  EXPECT_EQ(p.unsorted_instructions, 12u);
  EXPECT_EQ(p.indexed_points, 1u << 17);
  EXPECT_EQ(p.indexed_points_per_brick, 32u);
  EXPECT_EQ(p.points_per_job, 8u);
  EXPECT_EQ(p.small_points, 4096u);
  EXPECT_EQ(p.joined_points, 16'384u);
  EXPECT_EQ(p.patience, 4u);
  EXPECT_EQ(p.slab_bricks, 16'384u);
  EXPECT_EQ(p.slab_instructions, 1u << 16);
  EXPECT_EQ(p.slab_quads, 1u << 21);
  EXPECT_EQ(p.rays, 1u << 15);
  EXPECT_EQ(p.round_bricks, 1u << 16);
  EXPECT_EQ(p.round_bricks_per_ray, 64u);
  EXPECT_EQ(p.borrowed_bytes, 1u << 16);
  EXPECT_EQ(p.dispatch_runs, 2u);
  EXPECT_TRUE(p.shares_loads && p.has_narrow_workgroups && p.compiles_late && p.maps_memory && p.borrows_memory);
}

TEST(DeviceProfile, ProcessorsWithOtherSubgroupsLoadForThemselves) {
  for (const std::uint32_t size : {4u, 16u}) {
    DeviceProfile expected = profile("cpu", 8);
    expected.shares_loads = false;
    expected.points_per_job = size;
    EXPECT_EQ(profile("cpu", size), expected) << size;
  }
}

TEST(DeviceProfile, AProcessorCutsADispatchIntoARunAThread) {
  EXPECT_EQ(profile("cpu", 8, 0).dispatch_runs, 1u);
  EXPECT_EQ(profile("cpu", 8, 12).dispatch_runs, 12u);
  EXPECT_EQ(profile("cpu", 8, 64).dispatch_runs, 16u);
}

TEST(DeviceProfile, GpusTakeMoreAtOnce) {
  const DeviceProfile processor = profile("cpu", 8), integrated = profile("integrated", 32),
                      discrete = profile("discrete", 32);
  EXPECT_LT(processor.submission_work, integrated.submission_work);
  EXPECT_LT(integrated.submission_work, discrete.submission_work);
  EXPECT_LT(processor.joined_points, discrete.joined_points);
  EXPECT_EQ(discrete.dispatch_runs, 1u);
  EXPECT_FALSE(discrete.shares_loads || discrete.has_narrow_workgroups || discrete.compiles_late);
  EXPECT_FALSE(discrete.maps_memory || discrete.borrows_memory || integrated.borrows_memory);
  EXPECT_TRUE(integrated.maps_memory);
  EXPECT_EQ(profile("virtual", 32), discrete);
  EXPECT_FALSE(profile("other", 32).maps_memory);
}

// The kernels of sorted points have workgroups of 64, and one dispatch has at most kMaxGroups workgroups.
TEST(DeviceProfile, SlabsFitTheirDispatches) {
  for (const char* type : {"cpu", "integrated", "discrete", "virtual", "other"}) {
    for (const std::uint32_t size : {0u, 1u, 4u, 8u, 16u, 32u, 64u, 128u}) {
      const DeviceProfile p = profile(type, size);
      EXPECT_GE(p.points_per_job, 1u);
      EXPECT_LE(p.points_per_job, 64u);
      EXPECT_LE(p.slab_quads, std::uint64_t{kMaxGroups} * 64);
      EXPECT_LE(p.joined_points, std::uint64_t{kMaxGroups} * 64);
      EXPECT_LE(p.slab_bricks, kMaxGroups) << "kernels that take a brick a workgroup";
      EXPECT_LE(p.small_points, p.joined_points);
    }
  }
}

TEST(DeviceProfile, EveryNumberIsToldOnce) {
  std::set<std::string> names;
  DeviceProfile filled{};
  for (const ProfileNumber& n : profile_numbers()) {
    EXPECT_TRUE(names.insert(n.name).second) << n.name;
    const bool is_flag = std::holds_alternative<bool DeviceProfile::*>(n.member);
    EXPECT_EQ(std::string(n.unit) == "flag", is_flag) << n.name;
    const DeviceProfile before = filled;
    std::visit([&](auto member) { filled.*member = filled.*member == 0; }, n.member);
    EXPECT_FALSE(filled == before) << n.name;
    EXPECT_EQ(n.of(filled), n.of(before) == 0 ? 1u : 0u) << "two names share a number: " << n.name;
  }
}

}  // namespace
}  // namespace isofield::gpu
