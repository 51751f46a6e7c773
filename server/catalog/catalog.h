// Scenes by name and version, in memory.
#pragma once

#include <absl/container/btree_map.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "blobtree/scene/operator_table.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::catalog {

// A scene as it was put or edited; immutable.
struct Entry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Scene> scene;
  // The custom operators at the time of the put. They are what the names in the scene's custom nodes mean, whatever
  // becomes of these names.
  std::shared_ptr<const blobtree::OperatorTable> operators;
};

// The condition under which a put happens.
struct Condition {
  bool must_be_absent = false;
  std::uint64_t version = 0;  // 0: any
};

// Thread-safe.
class Catalog {
 public:
  explicit Catalog(std::uint64_t max_scenes) : max_scenes_(max_scenes) {}

  struct Put {
    Entry entry;
    std::uint64_t replaced_version = 0;  // 0: none
  };
  // INVALID_ARGUMENT: the name is not allowed. ALREADY_EXISTS, NOT_FOUND, ABORTED: the condition does not hold.
  // RESOURCE_EXHAUSTED: the catalog is full.
  absl::StatusOr<Put> put(const std::string& name, v1::Scene scene,
                          std::shared_ptr<const blobtree::OperatorTable> operators, const Condition& condition);
  // NOT_FOUND: there is no such scene; the message lists the names that there are.
  absl::StatusOr<Entry> get(const std::string& name) const;
  // The scenes whose names come after this one, in the order of their names.
  std::vector<Entry> list(const std::string& after = "") const;
  // Returns the version that is removed. NOT_FOUND: there is no such scene.
  absl::StatusOr<std::uint64_t> remove(const std::string& name);

 private:
  absl::Status not_found(const std::string& name) const;

  const std::uint64_t max_scenes_;
  mutable std::mutex mutex_;
  absl::btree_map<std::string, Entry> scenes_;
  std::uint64_t last_version_ = 0;
};

}  // namespace isofield::catalog
