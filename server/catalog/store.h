// Where scenes and custom operators are kept by name and version.
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

// What is kept. Names and versions of one kind have nothing to do with those of another.
enum class Kind { kScene, kOperator };
inline constexpr std::size_t kKinds = 2;

// What is kept under a name. It is immutable, and shared by all who have got it from a store.
class Value {
 public:
  virtual ~Value() = default;
  // The form in which a value outlives the process; a Parse of its kind reads it.
  virtual std::string serialized() const = 0;
  // The bytes that count against Quota::bytes; 0 where nothing limits them. It costs nothing to ask.
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
  std::uint64_t version = 0;  // 0: any
};

// The most entries of a kind, and bytes of them.
struct Quota {
  std::uint64_t entries = UINT64_MAX;
  std::uint64_t bytes = UINT64_MAX;
};

struct Usage {
  std::uint64_t entries = 0, bytes = 0;
};

// Keeps records. It knows nothing of what the values are, and its errors are failures of the storage alone; what a
// caller asks for in vain is an outcome. Thread-safe.
//
// Every request for a named scene calls get(), and so must not wait there for a disk or a network. An implementation
// that has either keeps the records in memory too, and holds no lock that get() takes while it writes.
class Store {
 public:
  virtual ~Store() = default;

  struct Put {
    enum class Outcome {
      kDone,
      kIsThere,        // the condition wants it absent
      kIsNotThere,     // the condition wants a version
      kIsAtAnother,    // the condition wants another version than `found`
      kTooManyEntries,  // the quota: `amount` entries are there
      kTooManyBytes     // the quota: there would be `amount` bytes
    };
    Outcome outcome = Outcome::kDone;
    std::uint64_t version = 0;  // of the new record, where the put is done
    std::uint64_t found = 0;    // the version that was there before; 0: none
    std::uint64_t amount = 0;
  };
  // Checks the condition and the quota, and keeps the value under a new version, as one step. Versions of a kind grow
  // with each put, and none is used twice, whatever is removed.
  virtual absl::StatusOr<Put> put(Kind kind, const std::string& name, std::shared_ptr<const Value> value,
                                  const Condition& condition, const Quota& quota) = 0;

  // The record of each name, at one moment; nothing for a name that is not there.
  virtual absl::StatusOr<std::vector<std::optional<Record>>> get(Kind kind,
                                                                 std::span<const std::string> names) const = 0;

  // At most `most` records, in the order of their names, from the first name after `after` on.
  virtual absl::StatusOr<std::vector<Record>> list(Kind kind, const std::string& after, std::size_t most) const = 0;

  // Returns the record that is removed; nothing: there was none.
  virtual absl::StatusOr<std::optional<Record>> remove(Kind kind, const std::string& name) = 0;

  virtual absl::StatusOr<Usage> usage(Kind kind) const = 0;
};

}  // namespace isofield::catalog
