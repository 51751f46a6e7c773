#include <absl/strings/str_cat.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "client_impl.h"
#include "tensor.h"

namespace isofield {
namespace {

// The most chunks that are sent and not yet answered. They are enough to keep the server busy while a result is
// handled, and few enough that memory stays at some 30 MiB.
constexpr std::size_t kWindow = 16;

v1::Quantity quantity_of(bool gradient) {
  return gradient ? v1::VALUE_AND_GRADIENT : v1::VALUE;
}

// Each chunk that is not yet answered has a slot in shared memory for its points and then its results. There are few
// slots, so that they stay in the cache of the processor.
constexpr std::size_t kSlots = 4;
constexpr std::size_t kSlotPoints = 3 * sizeof(float) * Client::kChunkPoints;
constexpr std::size_t kSlotBytes = kSlotPoints + 4 * sizeof(float) * Client::kChunkPoints;

// One streamed evaluation: a thread of its own writes chunks, and the thread of the caller reads results. The chunks
// between the two wait in `in_flight_`; the threads share only this queue and the flags.
class StreamedEvaluation {
 public:
  using Stream = grpc::ClientReaderWriter<v1::EvaluateStreamRequest, v1::EvaluateResponse>;

  // `memory` has kSlots slots, or is null.
  StreamedEvaluation(v1::FieldService::Stub& stub, grpc::ClientContext& context, const SharedMemory* memory)
      : context_(context), memory_(memory), stream_(stub.EvaluateStream(&context)) {}

  absl::Status run(const v1::SceneRef& scene, bool gradient, const ChunkSource& source, const Client::ResultSink& sink,
                   const std::string& address) {
    std::thread writer([&] { write_all(scene, gradient, source); });
    const absl::Status read_status = read_all(gradient ? 4 : 1, sink);
    if (!read_status.ok()) context_.TryCancel();
    {
      const std::lock_guard lock(mutex_);
      reader_done_ = true;
    }
    changed_.notify_all();
    writer.join();
    const grpc::Status finished = stream_->Finish();
    // Errors of this side come first, since the error of the server is then only the result of the cancellation.
    if (!source_status_.ok()) return source_status_;
    if (!read_status.ok()) return read_status;
    if (!finished.ok()) return from_grpc(finished, address);
    if (!in_flight_.empty()) return absl::InternalError("the server ended the stream before all points were answered");
    return absl::OkStatus();
  }

 private:
  void write_all(const v1::SceneRef& scene, bool gradient, const ChunkSource& source) {
    v1::EvaluateStreamRequest request;
    *request.mutable_scene() = scene;
    request.set_quantity(quantity_of(gradient));
    request.set_max_answer_bytes(kMaxAnswerBytes);
    for (std::size_t number = 0;; ++number) {
      Chunk chunk;
      source_status_ = source(chunk);
      const std::span<const float> xyz = chunk.xyz;
      if (source_status_.ok() && (xyz.size() % 3 != 0 || xyz.size() > 3 * Client::kChunkPoints)) {
        source_status_ = absl::InvalidArgumentError(absl::StrCat("a chunk of points has ", xyz.size(),
                                                                 " coordinates; expected a multiple of 3 up to ",
                                                                 3 * Client::kChunkPoints));
      }
      if (!source_status_.ok()) {
        context_.TryCancel();
        return;
      }
      if (xyz.empty()) {
        // Without points, the first message still lets the server check the scene.
        if (number == 0) stream_->Write(request);
        stream_->WritesDone();
        return;
      }
      if (!memory_) set_points(xyz, *request.mutable_points());
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return in_flight_.size() < (memory_ ? kSlots : kWindow) || reader_done_; });
        if (reader_done_) return;
        in_flight_.push_back(std::move(chunk));
      }
      if (memory_) share(number, xyz, gradient ? 4 : 1, request);
      if (!stream_->Write(request)) return;  // the stream is broken: Finish() tells why
      request.clear_scene();
      request.clear_quantity();
      request.clear_max_answer_bytes();
    }
  }

  // Puts a chunk into its slot, which the answer to an earlier one has made free.
  void share(std::size_t number, std::span<const float> xyz, std::uint64_t columns,
             v1::EvaluateStreamRequest& request) {
    const std::size_t offset = number % kSlots * kSlotBytes;
    std::memcpy(memory_->data() + offset, xyz.data(), xyz.size_bytes());
    const auto name = [&](std::size_t at, std::uint64_t width, v1::SharedTensor& tensor) {
      tensor.set_region(memory_->region());
      tensor.set_offset(at);
      tensor.set_dtype(v1::Tensor::FLOAT32);
      tensor.clear_shape();
      tensor.add_shape(xyz.size() / 3);
      tensor.add_shape(width);
    };
    name(offset, 3, *request.mutable_shared_points());
    name(offset + kSlotPoints, columns, *request.mutable_shared_result());
  }

  absl::Status read_all(std::uint64_t columns, const Client::ResultSink& sink) {
    v1::EvaluateResponse response;
    std::size_t number = 0;    // index of the chunk that is being answered
    std::size_t answered = 0;  // points of this chunk that are answered already
    while (stream_->Read(&response)) {
      std::span<const float> xyz;
      {
        const std::lock_guard lock(mutex_);
        if (in_flight_.empty()) return absl::InternalError("the server answered more chunks than were sent");
        xyz = in_flight_.front().xyz.subspan(3 * answered);  // pushing to the back does not move the front
      }
      std::span<const float> results;
      if (memory_) {
        const std::byte* const at = memory_->data() + number % kSlots * kSlotBytes + kSlotPoints;
        results = {reinterpret_cast<const float*>(at), xyz.size() / 3 * columns};
      } else {
        const auto received = floats_of(response.result(), columns);
        if (!received.ok()) return received.status();
        results = *received;
      }
      const std::size_t points = results.size() / columns;
      if (points == 0 || points > xyz.size() / 3) {
        return absl::InternalError(
            absl::StrCat("the server answered ", points, " of the ", xyz.size() / 3, " points of a chunk"));
      }
      if (auto status = sink(xyz.first(3 * points), results); !status.ok()) return status;
      answered += points;
      if (3 * points < xyz.size()) continue;
      answered = 0;
      ++number;
      {
        const std::lock_guard lock(mutex_);
        in_flight_.pop_front();
      }
      changed_.notify_all();
    }
    return absl::OkStatus();
  }

  grpc::ClientContext& context_;
  const SharedMemory* const memory_;
  std::unique_ptr<Stream> stream_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Chunk> in_flight_;
  bool reader_done_ = false;
  absl::Status source_status_;  // only the writer uses it until it is joined
};

}  // namespace

absl::Status Client::Impl::stream(const v1::SceneRef& scene, bool gradient, const ChunkSource& source,
                                  const ResultSink& sink) {
  grpc::ClientContext context;
  set_timeout(context, options.stream_timeout);
  std::unique_ptr<SharedMemory> memory = take_shared_memory(kSlots * kSlotBytes);
  const absl::Status status =
      StreamedEvaluation(*fields, context, memory.get()).run(scene, gradient, source, sink, address);
  // The server may still write results of a stream that was broken off, so that its memory is not used again.
  if (memory && status.ok()) shared_memory.give(std::move(memory));
  return status;
}

absl::Status Client::evaluate(const v1::SceneRef& scene, bool gradient, const PointSource& source,
                              const ResultSink& sink) {
  return impl_->stream(
      scene, gradient,
      [&](Chunk& chunk) {
        const absl::Status status = source(chunk.kept);
        chunk.xyz = chunk.kept;
        return status;
      },
      sink);
}

absl::Status Client::Impl::evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                                    const std::function<void()>& restart, const ResultSink& sink) {
  if (xyz.size() % 3 != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("points: ", xyz.size(), " coordinates; expected a multiple of 3 (x, y, z of each point)"));
  }
  if (xyz.size() / 3 <= kUnaryPoints) {
    restart();
    return evaluate_message(scene, xyz, gradient, sink);
  }
  return retry([&] {
    std::size_t sent = 0;
    restart();
    return stream(
        scene, gradient,
        [&](Chunk& chunk) {
          chunk.xyz = xyz.subspan(sent, std::min(3 * kChunkPoints, xyz.size() - sent));
          sent += chunk.xyz.size();
          return absl::OkStatus();
        },
        sink);
  });
}

absl::Status Client::Impl::evaluate_message(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                                            const ResultSink& sink) {
  v1::EvaluateRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(quantity_of(gradient));
  request.set_max_answer_bytes(kMaxAnswerBytes);
  set_points(xyz, *request.mutable_points());
  v1::EvaluateResponse response;
  auto status = retry([&] {
    return call([&](grpc::ClientContext* context) { return fields->Evaluate(context, request, &response); });
  });
  if (!status.ok()) return status;
  const std::size_t columns = gradient ? 4 : 1;
  const auto results = floats_of(response.result(), columns);
  if (!results.ok()) return results.status();
  if (results->size() / columns != xyz.size() / 3) {
    return absl::InternalError(
        absl::StrCat("the server answered ", results->size() / columns, " of ", xyz.size() / 3, " points"));
  }
  return sink(xyz, *results);
}

absl::StatusOr<std::vector<float>> Client::evaluate(const v1::SceneRef& scene, std::span<const float> xyz,
                                                    bool gradient) {
  std::vector<float> all;
  const absl::Status status = impl_->evaluate(
      scene, xyz, gradient,
      [&] {
        all.clear();
        all.reserve(xyz.size() / 3 * (gradient ? 4 : 1));
      },
      [&](std::span<const float>, std::span<const float> results) {
        all.insert(all.end(), results.begin(), results.end());
        return absl::OkStatus();
      });
  if (!status.ok()) return status;
  return all;
}

absl::Status Client::evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                              std::span<float> results) {
  const std::size_t wanted = xyz.size() / 3 * (gradient ? 4 : 1);
  if (results.size() != wanted) {
    return absl::InvalidArgumentError(absl::StrCat("results: room for ", results.size(), " numbers; expected ", wanted,
                                                   " for ", xyz.size() / 3, " points"));
  }
  float* to = results.data();
  return impl_->evaluate(
      scene, xyz, gradient, [&] { to = results.data(); },
      [&](std::span<const float>, std::span<const float> part) {
        to = std::copy(part.begin(), part.end(), to);
        return absl::OkStatus();
      });
}

absl::StatusOr<Grid> Client::evaluate_grid(const v1::SceneRef& scene, const std::array<double, 3>& origin,
                                           const std::array<double, 3>& spacing,
                                           const std::array<std::uint64_t, 3>& counts, bool gradient) {
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(quantity_of(gradient));
  request.set_max_answer_bytes(kMaxAnswerBytes);
  for (int axis = 0; axis < 3; ++axis) {
    request.add_origin(origin[axis]);
    request.add_spacing(spacing[axis]);
    request.add_counts(counts[axis]);
  }
  const std::size_t columns = gradient ? 4 : 1;
  Grid grid;
  const auto attempt = [&]() -> absl::Status {
    grid = Grid{counts, {}};
    grpc::ClientContext context;
    Impl::set_timeout(context, impl_->options.stream_timeout);
    const auto stream = impl_->fields->EvaluateGrid(&context, request);
    v1::EvaluateGridResponse response;
    absl::Status status;
    while (status.ok() && stream->Read(&response)) {
      // Parts follow one another without a gap, whether they are whole layers or not.
      const std::uint64_t row = response.first_layer() * counts[1] + response.first_row();
      if ((row * counts[0] + response.first_column()) * columns != grid.values.size()) {
        status = absl::InternalError("the server sent the parts of a grid out of order");
      } else {
        status = append_floats(response.result(), columns, grid.values);
      }
    }
    if (!status.ok()) context.TryCancel();
    const grpc::Status finished = stream->Finish();
    if (!status.ok()) return status;
    if (!finished.ok()) return from_grpc(finished, impl_->address);
    if (grid.values.size() / columns != counts[0] * counts[1] * counts[2]) {
      return absl::InternalError("the server ended the stream before all layers of the grid were sent");
    }
    return absl::OkStatus();
  };
  if (auto status = impl_->retry(attempt); !status.ok()) return status;
  return grid;
}

}  // namespace isofield
