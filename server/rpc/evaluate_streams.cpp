#include "rpc/evaluate_streams.h"

#include <absl/strings/str_cat.h>

#include <deque>
#include <optional>

#include "base/guarded.h"
#include "base/mutex.h"
#include "rpc/answer_limit.h"
#include "rpc/evaluate_arguments.h"
#include "rpc/handler.h"
#include "rpc/result_message.h"
#include "rpc/unreadable_requests.h"

namespace isofield::rpc {
namespace {

// A stream has at most so many messages at hand: one is decoded, one is on the device, and one is written.
constexpr std::size_t kAtHand = 3;

}  // namespace

// One call of EvaluateStream. It is made when gRPC is asked for the next call, and deletes itself when that call has
// ended and nothing for it is under way. Its functions may run on several threads.
class EvaluateStreams::Stream {
 public:
  explicit Stream(EvaluateStreams& streams) : streams_(streams), member_(streams.threads_), peer_(&context_) {
    context_.AsyncNotifyWhenDone(&ended_);
    grpc::ServerCompletionQueue* const queue = streams_.threads_.queue();
    streams_.service_.RequestEvaluateStream(&context_, &peer_, queue, queue, &came_);
  }
  ~Stream() {
    if (is_open_) --streams_.open_;
  }

 private:
  // A message with points, which lives from its reading until its answer is written.
  struct Work {
    v1::EvaluateStreamRequest request;
    MessagePoints points;
    Admission::Ticket ticket;              // counts the points until they are evaluated
    std::optional<ResultMessage> result;   // absent if results go into shared memory
    std::deque<grpc::ByteBuffer> answers;  // the result's unwritten messages; empty until the first one is due
    bool is_done = false;
    absl::Status status;
  };

  void on_call(bool is_ok) {
    if (!is_ok) {  // the server is shut down, so that no call has come and ended_ will not be called
      delete this;
      return;
    }
    new Stream(streams_);
    mutex_.lock();
    is_open_ = true;
    const int most = streams_.service_.limits().max_streams;
    if (++streams_.open_ > most) {
      decide(absl::ResourceExhaustedError(absl::StrCat(
          most,
          " streams are open, as many as are admitted (three quarters of --max-threads): close one, or try again")));
    }
    leave();
  }

  void on_read(bool is_ok) {
    mutex_.lock();
    if (!is_ok || outcome_) {
      is_reading_ = false;
      is_input_over_ = true;
      if (!batch_) {
        input_status_ =
            absl::InvalidArgumentError("the stream is empty: expected a first message that states the scene");
      }
      return leave();
    }
    mutex_.unlock();
    // No other thread reads or parses a message until is_reading_ is false.
    auto work = std::make_unique<Work>();
    const absl::Status status = base::guarded([&] { return parse(work->request); });
    Work* const to_do = status.ok() && PointFields(work->request).has_points() ? work.get() : nullptr;
    mutex_.lock();
    is_reading_ = false;
    if (!status.ok()) {
      is_input_over_ = true;
      input_status_ = status;
    }
    if (!to_do) return leave();
    work_.push_back(std::move(work));
    read_next();  // while this one is evaluated
    mutex_.unlock();
    evaluate(*to_do);
  }

  void on_evaluated(Work& work, absl::Status status) {
    mutex_.lock();
    work.status = std::move(status);
    work.ticket = {};
    work.is_done = true;
    leave();
  }

  void on_written(bool is_ok) {
    mutex_.lock();
    is_writing_ = false;
    Work& work = *work_.front();
    work.answers.pop_front();
    if (work.answers.empty()) {
      points_answered_ += work.points.points.size();
      work_.pop_front();
    }
    if (!is_ok && !outcome_) decide(client_gone());
    leave();
  }

  void on_part_done() {
    mutex_.lock();
    leave();
  }

  // Reads the message that has come. The first one also states the scene, the quantity and other settings of the
  // stream.
  absl::Status parse(v1::EvaluateStreamRequest& request) {
    if (absl::Status status = parse_request(incoming_, request); !status.ok()) return status;
    if (batch_) {
      const bool is_bare = !request.has_scene() && request.quantity() == v1::QUANTITY_UNSPECIFIED &&
                           request.priority() == v1::PRIORITY_UNSPECIFIED && request.max_answer_bytes() == 0;
      if (is_bare) return absl::OkStatus();
      return absl::InvalidArgumentError(
          "scene, quantity, priority and max_answer_bytes are stated in a stream's first message alone");
    }
    const absl::StatusOr<AnswerLimit> limit = AnswerLimit::of_stream(request.max_answer_bytes());
    if (!limit.ok()) return limit.status();
    limit_ = *limit;
    absl::StatusOr<engine::PointBatch> batch = streams_.service_.begin(context_, request);
    if (!batch.ok()) return batch.status();
    batch->cancelled = [this] { return is_over_ || context_.IsCancelled(); };
    batch_ = *std::move(batch);
    return absl::OkStatus();
  }

  // Reads the points of a message and submits them. A large batch is evaluated on this thread.
  void evaluate(Work& work) {
    engine::PointBatch batch = *batch_;
    absl::StatusOr<MessagePoints> points =
        base::guarded([&] { return streams_.service_.points_of(work.request, batch.layout); });
    if (!points.ok()) return on_evaluated(work, points.status());
    work.points = *std::move(points);
    work.ticket = streams_.service_.batches().count(work.points.points.size());
    if (CallNotes* const notes = streams_.service_.log().notes_of(context_)) {
      notes->add_work("points", work.points.points.size());
    }
    batch.xyz = work.points.points.xyz();
    if (work.points.result) {
      batch.out = work.points.shared_numbers();
    } else {
      work.result.emplace(work.points.points.size(), batch.layout);
      batch.out = work.result->numbers();
    }
    streams_.service_.engine().submit(std::move(batch),
                                      [this, &work](const absl::Status& s) { on_evaluated(work, s); });
  }

  // Decides with which status the stream ends.
  void decide(const absl::Status& status) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    outcome_ = status;
    is_over_ = !status.ok();
  }

  void read_next() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (outcome_ || is_reading_ || is_input_over_ || work_.size() >= kAtHand) return;
    is_reading_ = true;
    ++parts_;
    peer_.Read(&incoming_, &read_);
  }

  // Starts whatever can start now: the next read, the next write, or the end. A thread must not touch this object after
  // the call, since what it starts may end and delete the object.
  void go_on() ABSL_UNLOCK_FUNCTION(mutex_) {
    const bool is_answer_ready = !outcome_ && !is_writing_ && !work_.empty() && work_.front()->is_done;
    if (is_answer_ready && !work_.front()->status.ok()) {
      const absl::Status& s = work_.front()->status;
      decide(absl::Status(s.code(), absl::StrCat("after ", points_answered_, " points: ", s.message())));
    } else if (is_answer_ready) {
      is_writing_ = true;
      ++parts_;
    } else if (!outcome_ && work_.empty() && is_input_over_) {
      decide(input_status_);
    }
    read_next();
    if (outcome_ && !is_writing_ && !is_finished_) {
      is_finished_ = true;
      ++parts_;
      peer_.Finish(finish(context_, *outcome_), &part_done_);
    }
    Work* const work = is_answer_ready && is_writing_ ? work_.front().get() : nullptr;
    mutex_.unlock();
    if (work == nullptr) return;
    if (work->answers.empty()) work->answers = answers_of(*work);
    peer_.Write(work->answers.front(), &written_);
  }

  std::deque<grpc::ByteBuffer> answers_of(Work& work) const {
    if (!work.result) return {empty_result()};
    return work.result->take_parts(limit_.rows(batch_->layout.bytes()));
  }

  // Ends one part of what is under way. Deletes the object if it was the last part, else does the same as go_on().
  void leave() ABSL_UNLOCK_FUNCTION(mutex_) {
    if (--parts_ > 0) return go_on();
    mutex_.unlock();
    delete this;
  }

  EvaluateStreams& streams_;
  const CallThreads::Member member_;
  grpc::ServerContext context_;
  grpc::ServerAsyncReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer> peer_;
  // gRPC calls ended_ when the call has been answered, cancelled or broken off. The context must live until then.
  CallThreads::Event came_ = [this](bool is_ok) { on_call(is_ok); };
  CallThreads::Event read_ = [this](bool is_ok) { on_read(is_ok); };
  CallThreads::Event written_ = [this](bool is_ok) { on_written(is_ok); };
  CallThreads::Event part_done_ = [this](bool) { on_part_done(); }, ended_ = part_done_;

  grpc::ByteBuffer incoming_;                // used by the thread that reads
  std::optional<engine::PointBatch> batch_;  // set by the first message; it lacks the points
  AnswerLimit limit_;                        // set by the first message
  std::atomic<bool> is_over_ = false;        // the stream has failed, so that results are no longer needed

  base::Mutex mutex_;
  std::deque<std::unique_ptr<Work>> work_ ABSL_GUARDED_BY(mutex_);  // in the order in which the messages came
  // The number of parts under way: operations of gRPC and evaluations. The first two are the arrival of the call and
  // its end, which different threads may handle at the same time.
  int parts_ ABSL_GUARDED_BY(mutex_) = 2;
  bool is_open_ ABSL_GUARDED_BY(mutex_) = false, is_reading_ ABSL_GUARDED_BY(mutex_) = false;
  bool is_writing_ ABSL_GUARDED_BY(mutex_) = false, is_input_over_ ABSL_GUARDED_BY(mutex_) = false;
  bool is_finished_ ABSL_GUARDED_BY(mutex_) = false;
  absl::Status input_status_ ABSL_GUARDED_BY(mutex_);
  std::optional<absl::Status> outcome_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t points_answered_ ABSL_GUARDED_BY(mutex_) = 0;
};

void EvaluateStreams::start(int threads) {
  new Stream(*this);
  threads_.start(threads);
}

}  // namespace isofield::rpc
