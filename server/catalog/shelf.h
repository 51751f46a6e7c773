// Gives access to one kind of values in a store, scenes or operators, and turns outcomes into the errors that clients
// see.
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

// The common part of Catalog and OperatorCatalog. Thread-safe.
class Shelf {
 public:
  // Errors speak of the kind with these words.
  struct Words {
    const char* one;   // "scene"
    const char* many;  // "scenes"
    // Returns the message of an error: nothing has this name. `there` lists the names that there are, as in
    // "'a', 'b', ..."; it is empty if there are none.
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
  // RESOURCE_EXHAUSTED: the quota is used up.
  absl::StatusOr<Put> put(const std::string& name, std::shared_ptr<const Value> value, const Condition& condition = {});
  // NOT_FOUND: nothing has this name.
  absl::StatusOr<Record> get(const std::string& name) const;
  // Returns the records that several names have at one moment, in the order of the names; a name that is not there has
  // none.
  absl::StatusOr<std::vector<std::optional<Record>>> get_all(std::span<const std::string> names) const;
  absl::StatusOr<std::vector<Record>> list(const std::string& after, std::size_t most) const;
  // Returns the record that is removed. NOT_FOUND: nothing has this name.
  absl::StatusOr<Record> remove(const std::string& name);
  absl::StatusOr<Usage> usage() const { return store_.usage(kind_); }

  // Returns the names that there are, ten at most, as in "'a', 'b', ..."; the text is empty if there are none.
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
