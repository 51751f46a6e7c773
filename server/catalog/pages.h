// Walks through all entries of a catalog, however many there are, by asking for a page of them at a time.
#pragma once

#include <absl/status/status.h>

#include <cstddef>
#include <string>

#include "base/status_macros.h"

namespace isofield::catalog {

// Calls add(entry), which returns StatusOr<bool>, for the entries of a catalog in the order of their names, from the
// first name after `after` on, until add() returns false or an error. The walk may or may not meet entries that are put
// or removed during it.
template <class SomeCatalog, class Add>
absl::Status for_each_after(const SomeCatalog& catalog, std::string after, const Add& add) {
  constexpr std::size_t kPage = 256;
  while (true) {
    ISOFIELD_ASSIGN_OR_RETURN(const auto page, catalog.list(after, kPage));
    for (const auto& entry : page) {
      ISOFIELD_ASSIGN_OR_RETURN(const bool goes_on, add(entry));
      if (!goes_on) return absl::OkStatus();
    }
    if (page.size() < kPage) return absl::OkStatus();
    after = page.back().name;
  }
}

}  // namespace isofield::catalog
