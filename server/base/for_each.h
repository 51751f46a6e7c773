// ForEach runs work in parts that may run at the same time. Code that is given one can use threads without owning any.
#pragma once

#include <cstddef>
#include <functional>

namespace isofield::base {

// for_each(count, work) calls work(0) to work(count - 1), each once, on as many threads as it likes, and returns when
// all have returned. The function may be empty; then the code that was given it does the work undivided.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

}  // namespace isofield::base
