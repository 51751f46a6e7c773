#include "rpc/evaluate_calls.h"

#include <atomic>

#include "rpc/handler.h"

namespace isofield::rpc {

// One call of Evaluate. It is made when gRPC is asked for the next call, and deletes itself when that call has ended.
class EvaluateCalls::Call {
 public:
  explicit Call(EvaluateCalls& calls) : calls_(calls), member_(calls.threads_), responder_(&context_) {
    context_.AsyncNotifyWhenDone(&ended_);
    grpc::ServerCompletionQueue* const queue = calls_.threads_.queue();
    calls_.service_.RequestEvaluate(&context_, &incoming_, &responder_, queue, queue, &came_);
  }

 private:
  void on_call(bool is_ok) {
    if (!is_ok) {  // the server is shut down, so that no call has come and ended_ will not be called
      delete this;
      return;
    }
    new Call(calls_);
    calls_.service_.evaluate(context_, incoming_, request_,
                             [this](const absl::Status& status, const grpc::ByteBuffer& response) {
                               if (status.ok()) return responder_.Finish(response, grpc::Status::OK, &answered_);
                               responder_.FinishWithError(finish(context_, status), &answered_);
                             });
  }
  void on_part_done() {
    if (--parts_left_ == 0) delete this;
  }

  EvaluateCalls& calls_;
  const CallThreads::Member member_;
  grpc::ServerContext context_;
  grpc::ByteBuffer incoming_;
  v1::EvaluateRequest request_;
  grpc::ServerAsyncResponseWriter<grpc::ByteBuffer> responder_;
  std::atomic<int> parts_left_ = 2;  // answered_ and ended_
  // gRPC calls ended_ when the call has been answered, cancelled or broken off. The context must live until then.
  CallThreads::Event came_ = [this](bool is_ok) { on_call(is_ok); };
  CallThreads::Event answered_ = [this](bool) { on_part_done(); }, ended_ = answered_;
};

void EvaluateCalls::start(int threads) {
  new Call(*this);
  threads_.start(threads);
}

}  // namespace isofield::rpc
