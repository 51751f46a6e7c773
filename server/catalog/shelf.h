// One kind of things in a store, with the errors that clients are told.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "catalog/store.h"

namespace isofield::catalog {

// What catalogues of scenes and of operators have in common. Thread-safe.
class Shelf {
 public:
  // The words by which errors speak of the kind.
  struct Words {
    const char* one;   // "scene"
    const char* many;  // "scenes"
    // Says that there is nothing of this name. `there` lists the names that there are, "'a', 'b', ..."; it is empty
    // where there are none.
    std::function<std::string(const std::string& name, const std::string& there)> not_found;
  };

  // `store` must outlive this.
  Shelf(Store& store, Kind kind, const Quota& quota, Words words)
      : store_(store), kind_(kind), quota_(quota), words_(std::move(words)) {}

  struct Put {
    Record record;
    std::uint64_t replaced_version = 0;  // 0: none
  };
  // INVALID_ARGUMENT: the name is not allowed. ALREADY_EXISTS, NOT_FOUND, ABORTED: the condition does not hold.
  // RESOURCE_EXHAUSTED: the quota.
  absl::StatusOr<Put> put(const std::string& name, std::shared_ptr<const Value> value,
                          const Condition& condition = {});
  // NOT_FOUND: there is nothing of this name.
  absl::StatusOr<Record> get(const std::string& name) const;
  // The same for several names at one moment; nothing for a name that is not there.
  absl::StatusOr<std::vector<std::optional<Record>>> get_all(std::span<const std::string> names) const;
  absl::StatusOr<std::vector<Record>> list(const std::string& after, std::size_t most) const;
  // Returns what is removed. NOT_FOUND: there is nothing of this name.
  absl::StatusOr<Record> remove(const std::string& name);
  absl::StatusOr<Usage> usage() const { return store_.usage(kind_); }

  // "'a', 'b', ...", ten names at most; empty where there are none.
  absl::StatusOr<std::string> names() const;

 private:
  absl::Status not_found(const std::string& name) const;
  absl::Status refusal(const std::string& name, const Condition& condition, const Store::Put& put) const;

  Store& store_;
  const Kind kind_;
  const Quota quota_;
  const Words words_;
};

}  // namespace isofield::catalog
