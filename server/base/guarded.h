// Turns exceptions into statuses. isofield reports its own errors as statuses; most exceptions come from the standard
// library when memory runs out.
#pragma once

#include <absl/status/status.h>
#include <absl/strings/str_cat.h>

#include <exception>
#include <new>

namespace isofield::base {

// Calls a function that returns a Status or a StatusOr. An exception becomes a status: RESOURCE_EXHAUSTED where memory
// has run out, else INTERNAL.
template <class Function>
auto guarded(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError("the server has too little memory for this request: ask for less at once");
  } catch (const std::exception& error) {
    return absl::InternalError(absl::StrCat("the server met an unexpected error: ", error.what()));
  } catch (...) {
    return absl::InternalError("the server met an unexpected error, of an unknown kind");
  }
}

}  // namespace isofield::base
