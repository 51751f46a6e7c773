// Tells ThreadSanitizer how Abseil and gRPC hand data from one thread to another: under locks of Abseil, and through
// completion queues of gRPC. Debian builds both without ThreadSanitizer, so that it would take each hand-over for a
// data race. A program that links this file calls these functions in place of the libraries' own, which they call in
// turn. The libraries do the same within that program.
#include <absl/synchronization/mutex.h>
#include <dlfcn.h>
#include <grpc/grpc.h>
#include <sanitizer/tsan_interface.h>

#include <cstdio>
#include <cstdlib>

namespace {

// Returns the library's own function of that mangled name.
template <class Function>
Function* original(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  if (found == nullptr) {
    std::fprintf(stderr, "tests/sanitizers/hand_overs.cpp: no library has %s\n", name);
    std::abort();
  }
  return reinterpret_cast<Function*>(found);
}

using Act = void(absl::Mutex*);
using Try = bool(absl::Mutex*);
using Wait = void(absl::CondVar*, absl::Mutex*);
using WaitFor = bool(absl::CondVar*, absl::Mutex*, absl::Duration);
using WaitUntil = bool(absl::CondVar*, absl::Mutex*, absl::Time);

}  // namespace

// The mangled names have the version of Debian's Abseil in them: absl::debian3.
#define ISOFIELD_ABSEIL "_ZN4absl7debian3"

namespace absl {

void Mutex::Lock() {
  static auto* const lock = original<Act>(ISOFIELD_ABSEIL "5Mutex4LockEv");
  lock(this);
  __tsan_acquire(this);
}

void Mutex::Unlock() {
  static auto* const unlock = original<Act>(ISOFIELD_ABSEIL "5Mutex6UnlockEv");
  __tsan_release(this);
  unlock(this);
}

bool Mutex::TryLock() {
  static auto* const try_lock = original<Try>(ISOFIELD_ABSEIL "5Mutex7TryLockEv");
  const bool is_locked = try_lock(this);
  if (is_locked) __tsan_acquire(this);
  return is_locked;
}

// A thread that waits gives the mutex up, and takes it again.
void CondVar::Wait(Mutex* mutex) {
  static auto* const wait = original<::Wait>(ISOFIELD_ABSEIL "7CondVar4WaitEPNS0_5MutexE");
  __tsan_release(mutex);
  wait(this, mutex);
  __tsan_acquire(mutex);
}

bool CondVar::WaitWithTimeout(Mutex* mutex, Duration timeout) {
  static auto* const wait = original<WaitFor>(ISOFIELD_ABSEIL "7CondVar15WaitWithTimeoutEPNS0_5MutexENS0_8DurationE");
  __tsan_release(mutex);
  const bool is_late = wait(this, mutex, timeout);
  __tsan_acquire(mutex);
  return is_late;
}

bool CondVar::WaitWithDeadline(Mutex* mutex, Time deadline) {
  static auto* const wait = original<WaitUntil>(ISOFIELD_ABSEIL "7CondVar16WaitWithDeadlineEPNS0_5MutexENS0_4TimeE");
  __tsan_release(mutex);
  const bool is_late = wait(this, mutex, deadline);
  __tsan_acquire(mutex);
  return is_late;
}

}  // namespace absl

// The thread that starts an operation names it by a tag. The queue returns the tag to the thread that goes on with it.
extern "C" {

grpc_call_error grpc_call_start_batch(grpc_call* call, const grpc_op* ops, size_t count, void* tag, void* reserved) {
  static auto* const start = original<decltype(grpc_call_start_batch)>("grpc_call_start_batch");
  __tsan_release(tag);
  return start(call, ops, count, tag, reserved);
}

grpc_call_error grpc_server_request_registered_call(grpc_server* server, void* method, grpc_call** call,
                                                    gpr_timespec* deadline, grpc_metadata_array* metadata,
                                                    grpc_byte_buffer** payload, grpc_completion_queue* calls,
                                                    grpc_completion_queue* queue, void* tag) {
  static auto* const request =
      original<decltype(grpc_server_request_registered_call)>("grpc_server_request_registered_call");
  __tsan_release(tag);
  return request(server, method, call, deadline, metadata, payload, calls, queue, tag);
}

grpc_event grpc_completion_queue_next(grpc_completion_queue* queue, gpr_timespec deadline, void* reserved) {
  static auto* const next = original<decltype(grpc_completion_queue_next)>("grpc_completion_queue_next");
  const grpc_event event = next(queue, deadline, reserved);
  if (event.type == GRPC_OP_COMPLETE) __tsan_acquire(event.tag);
  return event;
}

grpc_event grpc_completion_queue_pluck(grpc_completion_queue* queue, void* tag, gpr_timespec deadline, void* reserved) {
  static auto* const pluck = original<decltype(grpc_completion_queue_pluck)>("grpc_completion_queue_pluck");
  const grpc_event event = pluck(queue, tag, deadline, reserved);
  if (event.type == GRPC_OP_COMPLETE) __tsan_acquire(event.tag);
  return event;
}

}  // extern "C"
