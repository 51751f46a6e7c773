// One piece of work on the device: arrays go up, kernels run, arrays come down.
#pragma once

#include <absl/status/statusor.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device.h"

namespace isofield::engine {

// One thread. Where the device's memory is the host's, nothing is staged. What it submits takes its turn at the device
// until it is done.
class Session {
 public:
  // `turn`: one that is held already, for the first submission.
  static absl::StatusOr<Session> begin(gpu::Device& device, const gpu::Urgency& urgency = {},
                                       gpu::Turns::Turn turn = {});

  gpu::Commands& commands() { return commands_; }

  // A buffer on the device that holds `data` when the next dispatch runs.
  template <class T>
  absl::StatusOr<gpu::Buffer> upload(std::span<T> data) {
    return upload_bytes(std::as_bytes(data));
  }
  // The same for data that stays until the session is over, which keeps the buffer: a large array is not copied where
  // the device can read the host's.
  absl::StatusOr<const gpu::Buffer*> input(std::span<const float> data);
  // A buffer of undefined content to download() to `out`: where the device can write there, `out` itself.
  absl::StatusOr<const gpu::Buffer*> output(std::span<float> out);
  // A buffer of undefined content.
  absl::StatusOr<gpu::Buffer> scratch(std::size_t bytes);
  // Keeps a buffer until the session is over, for kernels that it runs.
  const gpu::Buffer& keep(gpu::Buffer buffer) { return kept_.emplace_back(std::move(buffer)); }
  // As upload() and scratch(), of buffers that the session keeps.
  template <class T>
  absl::StatusOr<const gpu::Buffer*> lend(std::span<T> data) {
    return lend(upload(data));
  }
  absl::StatusOr<const gpu::Buffer*> lend_scratch(std::size_t bytes) { return lend(scratch(bytes)); }
  // Fills `out` from the start of the buffer when run() returns; record it after the dispatches that write the buffer.
  // No work where output() gave it for `out`.
  template <class T>
  absl::Status download(const gpu::Buffer& buffer, std::span<T> out) {
    return download_bytes(buffer, std::as_writable_bytes(out));
  }
  // Submits what is recorded, waits for it, and goes on: others' work may run in between.
  absl::Status flush();
  // Submits, waits, and carries out the downloads. The session is over.
  absl::Status run();
  // The same in steps, for work of the host's beside the device's. The turn is held from submit() to the end of wait().
  absl::Status submit();
  absl::Status wait();
  void collect();

 private:
  struct Download {
    const std::byte* from;
    std::span<std::byte> to;
  };
  Session(gpu::Device& device, const gpu::Urgency& urgency, gpu::Turns::Turn turn, gpu::Commands commands)
      : device_(&device), urgency_(urgency), turn_(std::move(turn)), commands_(std::move(commands)) {}
  absl::StatusOr<const gpu::Buffer*> lend(absl::StatusOr<gpu::Buffer> buffer) {
    if (!buffer.ok()) return buffer.status();
    return &keep(*std::move(buffer));
  }
  absl::StatusOr<gpu::Buffer> upload_bytes(std::span<const std::byte> data);
  absl::Status download_bytes(const gpu::Buffer& buffer, std::span<std::byte> out);

  gpu::Device* device_;
  gpu::Urgency urgency_;
  gpu::Turns::Turn turn_;
  std::optional<std::chrono::steady_clock::time_point> submitted_;
  std::deque<gpu::Buffer> kept_;  // outlives the commands
  gpu::Commands commands_;
  std::vector<Download> downloads_;
};

}  // namespace isofield::engine
