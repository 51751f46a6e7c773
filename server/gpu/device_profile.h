// The numbers that fit the work to a device: how much goes to it at once, and which of several ways is taken.
//
// They change how long a request takes and how long others wait for it, and no result. shaders/README.md gives the
// reason for each number.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "gpu/device_description.h"

namespace isofield::gpu {

// The numbers as they stand are those of lavapipe with subgroups of 8 and one thread. Work is counted in instructions
// of tapes times points.
struct DeviceProfile {
  // Of one submission: what a cancelled request still waits for, and others with it.
  std::uint64_t submission_work = 1u << 21;
  // The same of kernels that are written for one tape, in instructions of cheap operators.
  std::uint64_t written_work = 1u << 22;
  // Longer tapes are interpreted: those with cheap operators alone, and others.
  std::uint64_t written_instructions = 48, written_heavy_instructions = 12;
  // Points of longer tapes are sorted by their bricks, and see pruned tapes.
  std::uint64_t unsorted_instructions = 12;
  // Points that are sorted while the device is at those before: so many at least, and so many a brick of the index.
  std::uint64_t indexed_points = 1u << 17, indexed_points_per_brick = 32;
  // Sorted points of one job: what a subgroup takes.
  std::uint64_t points_per_job = 8;
  // Batches of up to small_points are joined, up to joined_points of them.
  std::uint64_t small_points = 4096, joined_points = 16'384;
  // The last of so many submissions is that of the request that has waited longest.
  std::uint64_t patience = 4;

  // Bricks of a mesh in one submission, and instructions of their tapes.
  std::uint64_t slab_bricks = 16'384, slab_instructions = 1u << 16;
  // Quads of a mesh in one submission, and in one buffer of triangles.
  std::uint64_t slab_quads = 1u << 21;

  // Rays that are under way at once.
  std::uint64_t rays = 1u << 15;
  // Bricks that rays are walked through in a round: all together, and each.
  std::uint64_t round_bricks = 1u << 16, round_bricks_per_ray = 64;

  // Arrays of at least so many bytes are read where they lie, by devices that can.
  std::uint64_t borrowed_bytes = 1u << 16;
  // Runs of equal length into which the driver cuts a dispatch's workgroups, one a thread of its own; 1: it hands them
  // out as it goes.
  std::uint64_t dispatch_runs = 1;

  // The invocations of a subgroup load one tape's words together, and hand them round by shuffles.
  bool shares_loads = true;
  // Kernels that take a brick a workgroup run 8 invocations, and not 32.
  bool has_narrow_workgroups = true;
  // The driver compiles a kernel when it is first dispatched, and not when it is made.
  bool compiles_late = true;
  // The host reads and writes the device's memory as fast as its own.
  bool maps_memory = true;
  // The device can work on memory that the host has allocated, and loses nothing by it.
  bool borrows_memory = true;

  bool operator==(const DeviceProfile&) const = default;
};

// The profile of such a device. `host_threads`: what the host runs at once.
DeviceProfile profile_of(const DeviceDescription& device, unsigned host_threads);

// Every number of a profile as it is told to people.
struct ProfileNumber {
  const char* name;
  const char* unit;  // of a flag "flag": 1 where it holds
  const char* meaning;
  std::variant<std::uint64_t DeviceProfile::*, bool DeviceProfile::*> member;

  std::uint64_t of(const DeviceProfile& profile) const {
    return std::visit([&](auto m) { return static_cast<std::uint64_t>(profile.*m); }, member);
  }
};
std::span<const ProfileNumber> profile_numbers();

}  // namespace isofield::gpu
