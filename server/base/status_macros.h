// Macros that pass an error status on to the caller. ISOFIELD_RETURN_IF_ERROR takes an absl::Status;
// ISOFIELD_ASSIGN_OR_RETURN takes a StatusOr, and declares or assigns its value if there is one.
#pragma once

#include <absl/status/statusor.h>

#define ISOFIELD_RETURN_IF_ERROR(expression)                  \
  do {                                                        \
    if (absl::Status status_ = (expression); !status_.ok()) { \
      return status_;                                         \
    }                                                         \
  } while (false)

#define ISOFIELD_CONCAT_(a, b) a##b
#define ISOFIELD_CONCAT(a, b) ISOFIELD_CONCAT_(a, b)
#define ISOFIELD_ASSIGN_OR_RETURN(declaration, expression) \
  ISOFIELD_ASSIGN_OR_RETURN_(ISOFIELD_CONCAT(or_, __LINE__), declaration, expression)
#define ISOFIELD_ASSIGN_OR_RETURN_(value, declaration, expression) \
  auto value = (expression);                                       \
  if (!value.ok()) return value.status();                          \
  declaration = *std::move(value)
