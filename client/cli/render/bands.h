#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace isofield {

// Divides the rows [0, rows) into bands and calls work(first, last) for each of them, on as many threads as there are
// cores; it returns when all are done. Bands share no row, so that the picture does not depend on their number.
inline void for_each_band(int rows, const std::function<void(int first, int last)>& work) {
  const int count = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, std::max(1, rows / 16));
  std::vector<std::thread> threads;
  for (int i = 1; i < count; ++i) {
    threads.emplace_back(work, static_cast<int>(std::int64_t{rows} * i / count),
                         static_cast<int>(std::int64_t{rows} * (i + 1) / count));
  }
  work(0, rows / count);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace isofield
