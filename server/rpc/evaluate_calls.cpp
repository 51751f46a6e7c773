#include "rpc/evaluate_calls.h"

#include <atomic>

namespace isofield::rpc {

// From the wish for a call to the end of one. Deletes itself.
class EvaluateCalls::Call {
 public:
  explicit Call(EvaluateCalls& calls) : calls_(calls), responder_(&context_) {
    {
      const std::lock_guard lock(calls_.mutex_);
      ++calls_.calls_;
    }
    context_.AsyncNotifyWhenDone(&ended_);
    calls_.service_.RequestEvaluate(&context_, &request_, &responder_, calls_.queue_.get(), calls_.queue_.get(),
                                    &came_);
  }
  ~Call() {
    const std::lock_guard lock(calls_.mutex_);
    if (--calls_.calls_ == 0) calls_.none_left_.notify_one();
  }

 private:
  void on_call(bool is_ok) {
    if (!is_ok) {  // the server is shut down, and on_ended will not come
      delete this;
      return;
    }
    new Call(calls_);
    service().evaluate(context_, request_, response_,
                       [this](const grpc::Status& status) { responder_.Finish(response_, status, &answered_); });
  }
  void on_part_done(bool) {
    if (--parts_left_ == 0) delete this;
  }
  FieldService& service() { return calls_.service_; }

  EvaluateCalls& calls_;
  grpc::ServerContext context_;
  v1::EvaluateRequest request_;
  v1::EvaluateResponse response_;
  grpc::ServerAsyncResponseWriter<v1::EvaluateResponse> responder_;
  std::atomic<int> parts_left_ = 2;
  // Ended: answered, cancelled or broken off, which only then the context knows.
  Event came_{&Call::on_call, this}, answered_{&Call::on_part_done, this}, ended_{&Call::on_part_done, this};
};

void EvaluateCalls::start(int threads) {
  new Call(*this);
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

void EvaluateCalls::serve() {
  void* tag = nullptr;
  bool is_ok = false;
  while (queue_->Next(&tag, &is_ok)) {
    const Event event = *static_cast<const Event*>(tag);
    (event.call->*event.happened)(is_ok);
  }
}

void EvaluateCalls::stop() {
  if (threads_.empty()) return;
  {
    // For the server, a cancelled call has ended; it is answered into the queue all the same.
    std::unique_lock lock(mutex_);
    none_left_.wait(lock, [&] { return calls_ == 0; });
  }
  queue_->Shutdown();
  for (std::thread& t : threads_) t.join();
  threads_.clear();
}

}  // namespace isofield::rpc
