// Waits for what another thread brings about.
#pragma once

#include <chrono>
#include <thread>

namespace isofield::test_support {

// Asks until condition() holds. Returns false after two minutes, so that a fault fails the test that would hang
// otherwise.
template <class Condition>
bool eventually(const Condition& condition) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= limit) return false;
    std::this_thread::yield();
  }
  return true;
}

}  // namespace isofield::test_support
