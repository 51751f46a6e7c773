// Work in parts, for those who know of no threads.
#pragma once

#include <cstddef>
#include <functional>

namespace isofield::base {

// for_each(count, work) calls work(0) to work(count - 1), each once, on as many threads as it likes, and returns when
// all have returned. None: the one who has it does all at once.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

}  // namespace isofield::base
