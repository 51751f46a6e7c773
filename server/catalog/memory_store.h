// The store that the daemon uses. It keeps everything in memory, so its content is lost when the process ends.
#pragma once

#include <absl/container/btree_map.h>

#include <array>

#include "base/mutex.h"
#include "catalog/store.h"

namespace isofield::catalog {

// Keeps the values as they are and never serializes them. All functions hold one lock for a short time.
class MemoryStore final : public Store {
 public:
  absl::StatusOr<Put> put(Kind kind, const std::string& name, std::shared_ptr<const Value> value,
                          const Condition& condition, const Quota& quota) override;
  absl::StatusOr<std::vector<std::optional<Record>>> get(Kind kind, std::span<const std::string> names) const override;
  absl::StatusOr<std::vector<Record>> list(Kind kind, const std::string& after, std::size_t most) const override;
  absl::StatusOr<std::optional<Record>> remove(Kind kind, const std::string& name) override;
  absl::StatusOr<Usage> usage(Kind kind) const override;

 private:
  struct Shelf {
    absl::btree_map<std::string, Record> records;
    std::uint64_t last_version = 0;
    std::uint64_t bytes = 0;  // the sum of Value::bytes() of all values
  };
  Shelf& shelf(Kind kind) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return shelves_[static_cast<std::size_t>(kind)]; }
  const Shelf& shelf(Kind kind) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return shelves_[static_cast<std::size_t>(kind)];
  }

  mutable base::Mutex mutex_;
  std::array<Shelf, kKinds> shelves_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::catalog
