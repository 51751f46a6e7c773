// The profile of a device: the numbers that decide how much work goes to it at once, and which of several ways of doing
// the work is taken.
//
// The numbers change how long a request takes and how long others wait for it, but no result. shaders/README.md gives
// the reason for each number.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "gpu/device_description.h"

namespace isofield::gpu {

// The default values are those of lavapipe with subgroups of 8 and one thread. Work is counted in instructions of tapes
// times points.
struct DeviceProfile {
  // The most work of one submission. A cancelled request, and others with it, still wait for its end.
  std::uint64_t submission_work = 1u << 21;
  // The most work of one submission of a kernel that is written for one tape, in instructions of cheap operators.
  std::uint64_t written_work = 1u << 22;
  // A tape gets a kernel of its own if it has at most written_instructions and all its operators are cheap, or else at
  // most written_heavy_instructions. Kernels for all scenes interpret longer tapes.
  std::uint64_t written_instructions = 48, written_heavy_instructions = 12;
  // If an interpreted tape is longer, its points are sorted by bricks, and each brick has a pruned tape.
  std::uint64_t unsorted_instructions = 12;
  // The host sorts the next points while the device evaluates those before: indexed_points at once, or
  // indexed_points_per_brick for each brick of the scene's index, whichever is more.
  std::uint64_t indexed_points = 1u << 17, indexed_points_per_brick = 32;
  // One job has up to so many sorted points, which one subgroup evaluates.
  std::uint64_t points_per_job = 8;
  // Batches of up to small_points points are joined, to at most joined_points points.
  std::uint64_t small_points = 4096, joined_points = 16'384;
  // The last of every `patience` submissions is that of the request that has waited longest.
  std::uint64_t patience = 4;

  // The most bricks of a mesh in one submission, and the most instructions of their tapes.
  std::uint64_t slab_bricks = 16'384, slab_instructions = 1u << 16;
  // The most quads of a mesh in one submission and in one buffer of triangles.
  std::uint64_t slab_quads = 1u << 21;

  // The most rays that are followed at once.
  std::uint64_t rays = 1u << 15;
  // Rays are followed in rounds. In a round all rays together pass through about round_bricks bricks, and each ray
  // through at least one and at most round_bricks_per_ray.
  std::uint64_t round_bricks = 1u << 16, round_bricks_per_ray = 64;

  // A device that borrows memory uses arrays of at least so many bytes where the host has them.
  std::uint64_t borrowed_bytes = 1u << 16;
  // The driver cuts the workgroups of a dispatch into so many runs of equal length, one for each of its threads. 1: it
  // hands workgroups out one by one.
  std::uint64_t dispatch_runs = 1;

  // The invocations of a subgroup load the words of a tape together, and share them by shuffles.
  bool shares_loads = true;
  // Kernels that give each brick a workgroup have 8 invocations in it, or 32 if this is false.
  bool has_narrow_workgroups = true;
  // The driver compiles a kernel when it is first dispatched, and not when it is made.
  bool compiles_late = true;
  // The host reads and writes the device's memory as fast as its own.
  bool maps_memory = true;
  // The device can work on memory that the host has allocated, without a loss of speed.
  bool borrows_memory = true;

  bool operator==(const DeviceProfile&) const = default;
};

// Returns the profile of a device. `host_threads` is the number of threads that the host can run at once.
DeviceProfile profile_of(const DeviceDescription& device, unsigned host_threads);

// Describes one number of a profile to people. A flag has the unit "flag", and is 1 if it holds.
struct ProfileNumber {
  const char* name;
  const char* unit;
  const char* meaning;
  std::variant<std::uint64_t DeviceProfile::*, bool DeviceProfile::*> member;

  std::uint64_t of(const DeviceProfile& profile) const {
    return std::visit([&](auto m) { return static_cast<std::uint64_t>(profile.*m); }, member);
  }
};
// Returns the descriptions of all numbers.
std::span<const ProfileNumber> profile_numbers();

}  // namespace isofield::gpu
