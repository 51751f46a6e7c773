// Tells ThreadSanitizer of the locks of Abseil. Debian's Abseil and gRPC are built without it, so that it would take
// whatever gRPC hands from one of its threads to another under such a lock for a data race. A program that links this
// file calls these functions in place of Abseil's, which they call in turn; so does gRPC within that program.
#include <absl/synchronization/mutex.h>
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

#include <cstdio>
#include <cstdlib>

namespace {

// Returns Abseil's own function of that mangled name.
template <class Function>
Function* original(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  if (found == nullptr) {
    std::fprintf(stderr, "tests/sanitizers/abseil_locks.cpp: Abseil has no %s\n", name);
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

// Those who wait give the mutex up and take it again.
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
