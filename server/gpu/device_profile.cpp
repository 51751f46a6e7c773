#include "gpu/device_profile.h"

#include <algorithm>
#include <array>

namespace isofield::gpu {
namespace {

using P = DeviceProfile;

constexpr std::array kNumbers{
    ProfileNumber{"submission_work", "instructions x points", "work of one submission", &P::submission_work},
    ProfileNumber{"written_work", "instructions x points", "work of one submission of a kernel written for one tape",
                  &P::written_work},
    ProfileNumber{"written_instructions", "instructions", "longest tape of cheap operators that gets its own kernel",
                  &P::written_instructions},
    ProfileNumber{"written_heavy_instructions", "instructions", "longest tape with other operators that gets one",
                  &P::written_heavy_instructions},
    ProfileNumber{"unsorted_instructions", "instructions", "longest tape whose points are not sorted by bricks",
                  &P::unsorted_instructions},
    ProfileNumber{"indexed_points", "points", "least number of points that are sorted at once", &P::indexed_points},
    ProfileNumber{"indexed_points_per_brick", "points", "the same for each brick of the scene's index",
                  &P::indexed_points_per_brick},
    ProfileNumber{"points_per_job", "points", "sorted points that one subgroup takes", &P::points_per_job},
    ProfileNumber{"small_points", "points", "largest batch that is joined with others", &P::small_points},
    ProfileNumber{"joined_points", "points", "most points of joined batches", &P::joined_points},
    ProfileNumber{"patience", "submissions", "the last of so many is that of the longest wait", &P::patience},
    ProfileNumber{"slab_bricks", "bricks", "bricks of a mesh in one submission", &P::slab_bricks},
    ProfileNumber{"slab_instructions", "instructions", "instructions of these bricks' tapes", &P::slab_instructions},
    ProfileNumber{"slab_quads", "quads", "quads of a mesh in one submission", &P::slab_quads},
    ProfileNumber{"rays", "rays", "rays that are under way at once", &P::rays},
    ProfileNumber{"round_bricks", "bricks", "bricks that all rays are walked through in a round", &P::round_bricks},
    ProfileNumber{"round_bricks_per_ray", "bricks", "the most of these for one ray", &P::round_bricks_per_ray},
    ProfileNumber{"borrowed_bytes", "bytes", "least array that the device reads where it lies", &P::borrowed_bytes},
    ProfileNumber{"dispatch_runs", "runs", "equal runs into which the driver cuts a dispatch", &P::dispatch_runs},
    ProfileNumber{"shares_loads", "flag", "subgroups load tapes together", &P::shares_loads},
    ProfileNumber{"has_narrow_workgroups", "flag", "a brick's workgroup has 8 invocations, and not 32",
                  &P::has_narrow_workgroups},
    ProfileNumber{"compiles_late", "flag", "kernels are dispatched once when they are made", &P::compiles_late},
    ProfileNumber{"maps_memory", "flag", "the host writes into the device's memory", &P::maps_memory},
    ProfileNumber{"borrows_memory", "flag", "the device works on the host's memory", &P::borrows_memory},
};

// The assertion fails if a number of the struct is missing in the table: numbers take 8 bytes, flags one.
constexpr std::size_t kFlags = std::count_if(kNumbers.begin(), kNumbers.end(), [](const ProfileNumber& n) {
  return std::holds_alternative<bool DeviceProfile::*>(n.member);
});
static_assert(sizeof(DeviceProfile) == ((kNumbers.size() - kFlags) * 8 + kFlags + 7) / 8 * 8);

// The number of invocations in a workgroup of the kernels for sorted points.
constexpr std::uint64_t kWorkgroup = 64;

// The profile of a device that runs on the processor. Mesa's lavapipe has one thread for each processor, at most 16
// (lp_cs_tpool.c), and gives each of them a run of equal length.
DeviceProfile of_processor(const DeviceDescription& device, unsigned host_threads) {
  DeviceProfile profile;
  profile.dispatch_runs = std::clamp(host_threads, 1u, 16u);
  profile.shares_loads = device.subgroup_size == 8;
  return profile;
}

// The profile of a GPU, which gets `power` times as much work at once as lavapipe on two cores.
DeviceProfile of_gpu(std::uint64_t power) {
  DeviceProfile profile;
  profile.submission_work *= power;
  profile.written_work *= power;
  profile.slab_instructions *= power;
  profile.written_instructions = 96;
  profile.written_heavy_instructions = 32;
  profile.unsorted_instructions = 32;
  profile.indexed_points = 1u << 20;
  profile.indexed_points_per_brick = 64;
  profile.small_points = 16'384;
  profile.joined_points = 1u << 18;
  // Each brick has 16 octets of corners, and a workgroup takes 8 octets, so more bricks would not fit into one dispatch
  // of 65,535 workgroups.
  profile.slab_bricks = 32'000;
  profile.rays = 1u << 18;
  profile.round_bricks = 1u << 20;
  profile.shares_loads = false;
  profile.has_narrow_workgroups = false;
  profile.compiles_late = false;
  profile.maps_memory = false;
  profile.borrows_memory = false;
  return profile;
}

}  // namespace

DeviceProfile profile_of(const DeviceDescription& device, unsigned host_threads) {
  DeviceProfile profile;
  if (device.type == "cpu") {
    profile = of_processor(device, host_threads);
  } else if (device.type == "discrete" || device.type == "virtual") {
    profile = of_gpu(256);
  } else {
    profile = of_gpu(16);
    profile.maps_memory = device.type == "integrated";
  }
  profile.points_per_job = std::clamp<std::uint64_t>(device.subgroup_size, 1, kWorkgroup);
  return profile;
}

std::span<const ProfileNumber> profile_numbers() {
  return kNumbers;
}

}  // namespace isofield::gpu
