// The catalog of custom operators: it stores, finds, lists and removes them by name, and gives each change a new
// version.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catalog/scene_operators.h"
#include "catalog/shelf.h"
#include "catalog/store.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::catalog {

// One version of a custom operator: the message that was put, and what it was read into. It is immutable.
struct OperatorEntry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Operator> message;
  std::shared_ptr<const operators::Operator> op;
};

// The most bytes that all custom operators may take together. Sampled operators are the large ones.
inline constexpr std::uint64_t kMaxOperatorBytes = std::uint64_t{1} << 30;

// Keeps custom operators in a Store and words the errors that clients see. Thread-safe.
class OperatorCatalog {
 public:
  // `store` must outlive this.
  OperatorCatalog(Store& store, std::uint64_t max_operators);

  // Stores an operator under a new version. `op` is what `message` was read into. INVALID_ARGUMENT: the name is not
  // allowed, or is that of a built-in operator. RESOURCE_EXHAUSTED: the catalog is full.
  absl::StatusOr<OperatorEntry> put(const std::string& name, v1::Operator message,
                                    std::shared_ptr<const operators::Operator> op);
  // NOT_FOUND: there is no such custom operator; the message lists the names that there are.
  absl::StatusOr<OperatorEntry> get(const std::string& name) const;
  // Returns at most `most` operators, in the order of their names, from the first name after `after` on.
  absl::StatusOr<std::vector<OperatorEntry>> list(const std::string& after, std::size_t most) const;
  absl::Status remove(const std::string& name);
  // Returns the number of custom operators.
  absl::StatusOr<std::uint64_t> size() const;

  // Returns the operators that the custom nodes of a scene name, in their present versions. INVALID_ARGUMENT: a node
  // names an operator that does not exist; the message states the node and the operators that there are.
  absl::StatusOr<std::shared_ptr<const SceneOperators>> operators_of(const v1::Scene& scene) const;

  // Reads an operator from its serialized form, for a store that keeps bytes. DATA_LOSS: the bytes are broken.
  static absl::StatusOr<std::shared_ptr<const Value>> parse(const std::string& serialized);

 private:
  Shelf shelf_;
};

}  // namespace isofield::catalog
