// The interface of the storage that keeps scenes and custom operators by name and version. MemoryStore implements it.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isofield::catalog {

// The kinds of values that a store keeps. Each kind has its own names and versions.
enum class Kind { kScene, kOperator };
inline constexpr std::size_t kKinds = 2;

// A value that is kept under a name. It is immutable, and all who get it from a store share it.
class Value {
 public:
  virtual ~Value() = default;
  // Returns the value as bytes, which can outlive the process. The Parse function of the value's kind reads them.
  virtual std::string serialized() const = 0;
  // Returns how many bytes count against Quota::bytes; 0 if the bytes of this kind are not limited. A call must be
  // cheap.
  virtual std::uint64_t bytes() const = 0;
};

// Reads a value of one kind from its serialized form.
using Parse = std::function<absl::StatusOr<std::shared_ptr<const Value>>(const std::string& serialized)>;

struct Record {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const Value> value;
};

// The condition under which a put happens.
struct Condition {
  bool must_be_absent = false;
  std::uint64_t version = 0;  // the version that must be there; 0: any, or none
};

// The most entries of a kind, and the most bytes that they may have together.
struct Quota {
  std::uint64_t entries = UINT64_MAX;
  std::uint64_t bytes = UINT64_MAX;
};

struct Usage {
  std::uint64_t entries = 0, bytes = 0;
};

// Keeps records without knowing what the values are. A status that is not OK means that the storage has failed; a
// request that cannot be fulfilled is an outcome and no error. Thread-safe.
//
// Every request for a named scene calls get(), which therefore must not wait for a disk or a network. An implementation
// that writes to one keeps the records in memory as well, and must not hold a lock that get() takes while it writes.
class Store {
 public:
  virtual ~Store() = default;

  struct Put {
    enum class Outcome {
      kDone,
      kIsThere,         // the condition wants it absent
      kIsNotThere,      // the condition wants a version
      kIsAtAnother,     // the condition wants another version than `found`
      kTooManyEntries,  // the quota: `amount` entries are there
      kTooManyBytes     // the quota: there would be `amount` bytes
    };
    Outcome outcome = Outcome::kDone;
    std::uint64_t version = 0;  // the version of the new record, if the put is done
    std::uint64_t found = 0;    // the version that was there before; 0: none
    std::uint64_t amount = 0;
  };
  // Checks the condition and the quota, and keeps the value under a new version, as one step. Versions of a kind grow
  // with each put, and none is used twice, whatever is removed.
  virtual absl::StatusOr<Put> put(Kind kind, const std::string& name, std::shared_ptr<const Value> value,
                                  const Condition& condition, const Quota& quota) = 0;

  // Returns the records that the names have at one moment, in the order of the names. A name that is not there has
  // none.
  virtual absl::StatusOr<std::vector<std::optional<Record>>> get(Kind kind,
                                                                 std::span<const std::string> names) const = 0;

  // Returns at most `most` records, in the order of their names, from the first name after `after` on.
  virtual absl::StatusOr<std::vector<Record>> list(Kind kind, const std::string& after, std::size_t most) const = 0;

  // Returns the record that is removed, or nothing if there was none.
  virtual absl::StatusOr<std::optional<Record>> remove(Kind kind, const std::string& name) = 0;

  virtual absl::StatusOr<Usage> usage(Kind kind) const = 0;
};

}  // namespace isofield::catalog
