#include <absl/strings/str_cat.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "client_impl.h"
#include "tensor.h"

namespace isofield {
namespace {

// Chunks sent and not yet answered. Enough to keep the server busy while a result is handled, few enough that memory
// stays at some 30 MiB.
constexpr std::size_t kWindow = 16;

v1::Quantity quantity_of(bool gradient) {
  return gradient ? v1::VALUE_AND_GRADIENT : v1::VALUE;
}

// One streamed evaluation: a thread of its own writes chunks, the caller's thread reads results. The chunks between
// the two wait in `in_flight_`; only that queue and the flags are shared.
class StreamedEvaluation {
 public:
  using Stream = grpc::ClientReaderWriter<v1::EvaluateStreamRequest, v1::EvaluateResponse>;

  StreamedEvaluation(v1::FieldService::Stub& stub, grpc::ClientContext& context)
      : context_(context), stream_(stub.EvaluateStream(&context)) {}

  absl::Status run(const v1::SceneRef& scene, bool gradient, const Client::PointSource& source,
                   const Client::ResultSink& sink, const std::string& address) {
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
    // Our own errors first: the server's is then only the echo of the cancellation.
    if (!source_status_.ok()) return source_status_;
    if (!read_status.ok()) return read_status;
    if (!finished.ok()) return from_grpc(finished, address);
    if (!in_flight_.empty()) return absl::InternalError("the server ended the stream before all points were answered");
    return absl::OkStatus();
  }

 private:
  void write_all(const v1::SceneRef& scene, bool gradient, const Client::PointSource& source) {
    v1::EvaluateStreamRequest request;
    *request.mutable_scene() = scene;
    request.set_quantity(quantity_of(gradient));
    for (bool first = true;; first = false) {
      std::vector<float> xyz;
      source_status_ = source(xyz);
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
        if (first) stream_->Write(request);
        stream_->WritesDone();
        return;
      }
      set_points(xyz, *request.mutable_points());
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return in_flight_.size() < kWindow || reader_done_; });
        if (reader_done_) return;
        in_flight_.push_back(std::move(xyz));
      }
      if (!stream_->Write(request)) return;  // the stream is broken: Finish() tells why
      request.clear_scene();
      request.clear_quantity();
    }
  }

  absl::Status read_all(std::uint64_t columns, const Client::ResultSink& sink) {
    v1::EvaluateResponse response;
    std::vector<float> results;
    while (stream_->Read(&response)) {
      std::vector<float> xyz;
      {
        const std::lock_guard lock(mutex_);
        if (in_flight_.empty()) return absl::InternalError("the server answered more chunks than were sent");
        xyz = std::move(in_flight_.front());
        in_flight_.pop_front();
      }
      changed_.notify_all();
      results.clear();
      if (auto status = append_floats(response.result(), columns, results); !status.ok()) return status;
      if (results.size() / columns != xyz.size() / 3) {
        return absl::InternalError(absl::StrCat("the server answered ", results.size() / columns, " of ",
                                                xyz.size() / 3, " points of a chunk"));
      }
      if (auto status = sink(xyz, results); !status.ok()) return status;
    }
    return absl::OkStatus();
  }

  grpc::ClientContext& context_;
  std::unique_ptr<Stream> stream_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::vector<float>> in_flight_;
  bool reader_done_ = false;
  absl::Status source_status_;  // the writer's until it is joined
};

}  // namespace

absl::Status Client::evaluate(const v1::SceneRef& scene, bool gradient, const PointSource& source,
                              const ResultSink& sink) {
  grpc::ClientContext context;
  Impl::set_timeout(context, impl_->options.stream_timeout);
  return StreamedEvaluation(*impl_->fields, context).run(scene, gradient, source, sink, impl_->address);
}

absl::StatusOr<std::vector<float>> Client::evaluate(const v1::SceneRef& scene, std::span<const float> xyz,
                                                    bool gradient) {
  if (xyz.size() % 3 != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("points: ", xyz.size(), " coordinates; expected a multiple of 3 (x, y, z of each point)"));
  }
  if (xyz.size() / 3 <= kUnaryPoints) return evaluate_message(scene, xyz, gradient);
  std::vector<float> all;
  const auto status = impl_->retry([&] {
    std::size_t sent = 0;
    all.clear();
    all.reserve(xyz.size() / 3 * (gradient ? 4 : 1));
    return evaluate(
        scene, gradient,
        [&](std::vector<float>& chunk) {
          const auto next = xyz.subspan(sent, std::min(3 * kChunkPoints, xyz.size() - sent));
          chunk.assign(next.begin(), next.end());
          sent += next.size();
          return absl::OkStatus();
        },
        [&](std::span<const float>, std::span<const float> results) {
          all.insert(all.end(), results.begin(), results.end());
          return absl::OkStatus();
        });
  });
  if (!status.ok()) return status;
  return all;
}

absl::StatusOr<std::vector<float>> Client::evaluate_message(const v1::SceneRef& scene, std::span<const float> xyz,
                                                            bool gradient) {
  v1::EvaluateRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(quantity_of(gradient));
  set_points(xyz, *request.mutable_points());
  v1::EvaluateResponse response;
  auto status = impl_->retry([&] {
    return impl_->call(
        [&](grpc::ClientContext* context) { return impl_->fields->Evaluate(context, request, &response); });
  });
  if (!status.ok()) return status;
  const std::size_t columns = gradient ? 4 : 1;
  std::vector<float> results;
  if (status = append_floats(response.result(), columns, results); !status.ok()) return status;
  if (results.size() / columns != xyz.size() / 3) {
    return absl::InternalError(
        absl::StrCat("the server answered ", results.size() / columns, " of ", xyz.size() / 3, " points"));
  }
  return results;
}

absl::StatusOr<Grid> Client::evaluate_grid(const v1::SceneRef& scene, const std::array<double, 3>& origin,
                                           const std::array<double, 3>& spacing,
                                           const std::array<std::uint64_t, 3>& counts, bool gradient) {
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(quantity_of(gradient));
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
      const std::uint64_t layer = counts[0] * counts[1] * columns;
      if (layer == 0 || response.first_layer() * layer != grid.values.size()) {
        status = absl::InternalError("the server sent the layers of a grid out of order");
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
