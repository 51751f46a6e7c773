#include "catalog/memory_store.h"

#include <utility>

namespace isofield::catalog {

absl::StatusOr<Store::Put> MemoryStore::put(Kind kind, const std::string& name, std::shared_ptr<const Value> value,
                                            const Condition& condition, const Quota& quota) {
  using Outcome = Put::Outcome;
  const std::uint64_t value_bytes = value->bytes();
  // It is declared before the lock, so that its value, which nobody else may hold, is destroyed after the lock is
  // released.
  Record replaced;
  const base::MutexLock lock(mutex_);
  Shelf& there = shelf(kind);
  const auto it = there.records.find(name);
  const bool is_new = it == there.records.end();
  const std::uint64_t found = is_new ? 0 : it->second.version;
  const auto refuse = [&](Outcome outcome, std::uint64_t amount = 0) {
    return Put{.outcome = outcome, .found = found, .amount = amount};
  };
  if (condition.must_be_absent && !is_new) return refuse(Outcome::kIsThere);
  if (condition.version != 0 && is_new) return refuse(Outcome::kIsNotThere);
  if (condition.version != 0 && condition.version != found) return refuse(Outcome::kIsAtAnother);
  if (is_new && there.records.size() >= quota.entries) return refuse(Outcome::kTooManyEntries, there.records.size());
  const std::uint64_t bytes = there.bytes + value_bytes - (is_new ? 0 : it->second.value->bytes());
  if (bytes > quota.bytes) return refuse(Outcome::kTooManyBytes, bytes);
  there.bytes = bytes;
  const std::uint64_t version = ++there.last_version;
  replaced = std::exchange(there.records[name], Record{name, version, std::move(value)});
  return Put{.version = version, .found = found};
}

absl::StatusOr<std::vector<std::optional<Record>>> MemoryStore::get(Kind kind,
                                                                    std::span<const std::string> names) const {
  std::vector<std::optional<Record>> found;
  const base::MutexLock lock(mutex_);
  const auto& records = shelf(kind).records;
  for (const std::string& name : names) {
    const auto it = records.find(name);
    found.push_back(it == records.end() ? std::nullopt : std::optional(it->second));
  }
  return found;
}

absl::StatusOr<std::vector<Record>> MemoryStore::list(Kind kind, const std::string& after, std::size_t most) const {
  std::vector<Record> listed;
  const base::MutexLock lock(mutex_);
  const auto& records = shelf(kind).records;
  for (auto it = records.upper_bound(after); it != records.end() && listed.size() < most; ++it) {
    listed.push_back(it->second);
  }
  return listed;
}

absl::StatusOr<std::optional<Record>> MemoryStore::remove(Kind kind, const std::string& name) {
  const base::MutexLock lock(mutex_);
  Shelf& there = shelf(kind);
  const auto it = there.records.find(name);
  if (it == there.records.end()) return std::nullopt;
  std::optional<Record> removed = std::move(it->second);
  there.bytes -= removed->value->bytes();
  there.records.erase(it);
  return removed;
}

absl::StatusOr<Usage> MemoryStore::usage(Kind kind) const {
  const base::MutexLock lock(mutex_);
  return Usage{shelf(kind).records.size(), shelf(kind).bytes};
}

}  // namespace isofield::catalog
