#include "engine/session.h"

#include <optional>

#include "engine/request_times.h"

namespace isofield::engine {

using gpu::Buffer;

namespace {

using Clock = std::chrono::steady_clock;

std::optional<Buffer> borrow(gpu::Device& device, std::span<std::byte> bytes) {
  return bytes.size() < device.profile().borrowed_bytes ? std::nullopt : Buffer::borrow(device, bytes);
}

}  // namespace

absl::StatusOr<Session> Session::begin(gpu::Device& device, const gpu::Urgency& urgency, gpu::Turns::Turn turn) {
  absl::StatusOr<gpu::Commands> commands = gpu::Commands::begin(device);
  if (!commands.ok()) return commands.status();
  return Session(device, urgency, std::move(turn), *std::move(commands));
}

absl::StatusOr<Buffer> Session::scratch(std::size_t bytes) {
  return Buffer::create(*device_, bytes, Buffer::Use::kDevice);
}

absl::StatusOr<const Buffer*> Session::input(std::span<const float> data) {
  // The cast is safe, because kernels only read this buffer.
  float* const bytes = const_cast<float*>(data.data());
  if (auto borrowed = borrow(*device_, std::as_writable_bytes(std::span(bytes, data.size())))) {
    return &keep(*std::move(borrowed));
  }
  return lend(data);
}

absl::StatusOr<const Buffer*> Session::output(std::span<float> out) {
  if (auto borrowed = borrow(*device_, std::as_writable_bytes(out))) return &keep(*std::move(borrowed));
  return lend_scratch(out.size_bytes());
}

absl::StatusOr<Buffer> Session::upload_bytes(std::span<const std::byte> data) {
  absl::StatusOr<Buffer> buffer = scratch(data.size());
  if (!buffer.ok() || data.empty()) return buffer;
  if (buffer->data()) {
    std::memcpy(buffer->data(), data.data(), data.size());
    return buffer;
  }
  absl::StatusOr<Buffer> staging = Buffer::create(*device_, data.size(), Buffer::Use::kUpload);
  if (!staging.ok()) return staging.status();
  std::memcpy(staging->data(), data.data(), data.size());
  commands_.copy(*staging, 0, *buffer, 0, data.size());
  commands_.barrier();
  keep(*std::move(staging));
  return buffer;
}

absl::Status Session::download_bytes(const Buffer& buffer, std::span<std::byte> out) {
  if (out.empty() || buffer.data() == out.data()) return absl::OkStatus();
  if (buffer.data()) {
    downloads_.push_back({buffer.data(), out});
    return absl::OkStatus();
  }
  absl::StatusOr<Buffer> staging = Buffer::create(*device_, out.size(), Buffer::Use::kReadback);
  if (!staging.ok()) return staging.status();
  commands_.barrier();
  commands_.copy(buffer, 0, *staging, 0, out.size());
  downloads_.push_back({staging->data(), out});
  keep(*std::move(staging));
  return absl::OkStatus();
}

absl::Status Session::submit() {
  if (!commands_.has_work()) return absl::OkStatus();
  const Clock::time_point start = Clock::now();
  if (!turn_) turn_ = device_->turns().take(urgency_);
  submitted_ = Clock::now();
  if (RequestTimes* const times = TimedScope::current()) times->add_queued(*submitted_ - start);
  absl::Status status = commands_.submit();
  if (!status.ok()) turn_ = {};
  return status;
}

absl::Status Session::wait() {
  absl::Status status = commands_.wait();
  turn_ = {};
  RequestTimes* const times = TimedScope::current();
  if (times && submitted_) times->add_on_device(Clock::now() - *submitted_);
  submitted_.reset();
  return status;
}

void Session::collect() {
  for (const Download& d : downloads_) std::memcpy(d.to.data(), d.from, d.to.size());
}

absl::Status Session::flush() {
  if (absl::Status s = submit(); !s.ok()) return s;
  if (absl::Status s = wait(); !s.ok()) return s;
  absl::StatusOr<gpu::Commands> commands = gpu::Commands::begin(*device_);
  if (!commands.ok()) return commands.status();
  commands_ = *std::move(commands);
  return absl::OkStatus();
}

absl::Status Session::run() {
  if (absl::Status s = submit(); !s.ok()) return s;
  if (absl::Status s = wait(); !s.ok()) return s;
  collect();
  return absl::OkStatus();
}

}  // namespace isofield::engine
