#include "rpc/call_threads.h"

namespace isofield::rpc {

void CallThreads::start(int threads) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

void CallThreads::serve() {
  void* tag = nullptr;
  bool is_ok = false;
  while (queue_->Next(&tag, &is_ok)) {
    const Event event = *static_cast<const Event*>(tag);  // a copy, since the event may delete its call and so itself
    event(is_ok);
  }
}

void CallThreads::stop() {
  if (threads_.empty()) return;
  {
    // The server counts a cancelled call as ended, but the call is still answered into the queue. So it waits here for
    // all calls before it shuts the queue down.
    base::MutexLock lock(mutex_);
    while (!(calls_ == 0)) none_left_.wait(mutex_);
  }
  queue_->Shutdown();
  for (std::thread& t : threads_) t.join();
  threads_.clear();
}

}  // namespace isofield::rpc
