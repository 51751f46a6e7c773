// A Session is one piece of work on the device: it uploads arrays, runs kernels, and downloads their results.
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

// Belongs to one thread. It owns the commands, and the buffers that it keeps, until it is over. Arrays are copied
// through staging buffers only where the host cannot map the device's memory. Each submission takes a turn at the
// device (gpu/turns.h) and holds it until the device is done.
class Session {
 public:
  // `turn` is a turn that the caller holds already; the first submission uses it.
  static absl::StatusOr<Session> begin(gpu::Device& device, const gpu::Urgency& urgency = {},
                                       gpu::Turns::Turn turn = {});

  gpu::Commands& commands() { return commands_; }

  // Returns a buffer on the device that holds `data` when the next dispatch runs.
  template <class T>
  absl::StatusOr<gpu::Buffer> upload(std::span<T> data) {
    return upload_bytes(std::as_bytes(data));
  }
  // The same for data that stays unchanged until the session is over; the session keeps the buffer. A large array is
  // not copied where the device can read the host's memory.
  absl::StatusOr<const gpu::Buffer*> input(std::span<const float> data);
  // Returns a buffer of undefined content, to be passed to download() with `out`. Where the device can write to the
  // host's memory, the buffer is `out` itself.
  absl::StatusOr<const gpu::Buffer*> output(std::span<float> out);
  // Returns a buffer of undefined content, which the caller owns.
  absl::StatusOr<gpu::Buffer> scratch(std::size_t bytes);
  // Keeps a buffer until the session is over, because kernels of the session use it.
  const gpu::Buffer& keep(gpu::Buffer buffer) { return kept_.emplace_back(std::move(buffer)); }
  // The same as upload() and scratch(), but the session keeps the buffers.
  template <class T>
  absl::StatusOr<const gpu::Buffer*> lend(std::span<T> data) {
    return lend(upload(data));
  }
  absl::StatusOr<const gpu::Buffer*> lend_scratch(std::size_t bytes) { return lend(scratch(bytes)); }
  // Records that `out` is filled from the start of the buffer by the time run() returns. Call it after the dispatches
  // that write the buffer. It costs nothing where output() returned this buffer for `out`.
  template <class T>
  absl::Status download(const gpu::Buffer& buffer, std::span<T> out) {
    return download_bytes(buffer, std::as_writable_bytes(out));
  }
  // Submits what is recorded so far, waits for it, and starts to record anew. Other work may use the device in between.
  absl::Status flush();
  // Submits, waits, and carries out the downloads. The session is over then.
  absl::Status run();
  // These three do the same as run() in steps, so that the host can work while the device does. The session holds its
  // turn from submit() to the end of wait().
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
  std::deque<gpu::Buffer> kept_;  // declared before the commands, so that it outlives them
  gpu::Commands commands_;
  std::vector<Download> downloads_;
};

}  // namespace isofield::engine
