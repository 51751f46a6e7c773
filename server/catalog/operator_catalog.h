// Custom operators by name and version, in memory.
#pragma once

#include <absl/container/btree_map.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "blobtree/scene/operator_table.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::catalog {

// An operator as it was put, and as it was read; immutable.
struct OperatorEntry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Operator> message;
  std::shared_ptr<const operators::Operator> op;
};

// Thread-safe.
class OperatorCatalog {
 public:
  explicit OperatorCatalog(std::uint64_t max_operators) : max_operators_(max_operators) {}

  // `op` is what `message` was read into. INVALID_ARGUMENT: the name. RESOURCE_EXHAUSTED: full.
  absl::StatusOr<OperatorEntry> put(const std::string& name, v1::Operator message,
                                    std::shared_ptr<const operators::Operator> op);
  // NOT_FOUND, with the names that there are.
  absl::StatusOr<OperatorEntry> get(const std::string& name) const;
  // The operators whose names come after this one, in the order of their names.
  std::vector<OperatorEntry> list(const std::string& after = "") const;
  absl::Status remove(const std::string& name);
  std::uint64_t size() const;

  // The operators that a scene's custom nodes name, as they are now. INVALID_ARGUMENT: there is no such operator; names
  // the node and the operators that there are.
  absl::StatusOr<std::shared_ptr<const blobtree::OperatorTable>> table_for(const v1::Scene& scene) const;

 private:
  absl::Status not_found(const std::string& name) const;

  const std::uint64_t max_operators_;
  mutable std::mutex mutex_;
  absl::btree_map<std::string, OperatorEntry> operators_;
  std::uint64_t last_version_ = 0;
  std::uint64_t bytes_ = 0;  // of all messages
};

// Of all custom operators: samples are what makes them large.
inline constexpr std::uint64_t kMaxOperatorBytes = std::uint64_t{1} << 30;

}  // namespace isofield::catalog
