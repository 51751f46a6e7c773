// Custom operators by name and version.
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

// An operator as it was put, and as it was read; immutable.
struct OperatorEntry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Operator> message;
  std::shared_ptr<const operators::Operator> op;
};

// Of all custom operators: samples are what makes them large.
inline constexpr std::uint64_t kMaxOperatorBytes = std::uint64_t{1} << 30;

// Thread-safe.
class OperatorCatalog {
 public:
  // `store` must outlive this.
  OperatorCatalog(Store& store, std::uint64_t max_operators);

  // `op` is what `message` was read into. INVALID_ARGUMENT: the name. RESOURCE_EXHAUSTED: full.
  absl::StatusOr<OperatorEntry> put(const std::string& name, v1::Operator message,
                                    std::shared_ptr<const operators::Operator> op);
  // NOT_FOUND, with the names that there are.
  absl::StatusOr<OperatorEntry> get(const std::string& name) const;
  // At most `most` operators, in the order of their names, from the first name after `after` on.
  absl::StatusOr<std::vector<OperatorEntry>> list(const std::string& after, std::size_t most) const;
  absl::Status remove(const std::string& name);
  absl::StatusOr<std::uint64_t> size() const;

  // The operators that a scene's custom nodes name, as they are now. INVALID_ARGUMENT: there is no such operator; names
  // the node and the operators that there are.
  absl::StatusOr<std::shared_ptr<const SceneOperators>> operators_of(const v1::Scene& scene) const;

  // Reads operators for a store that keeps them as bytes.
  static absl::StatusOr<std::shared_ptr<const Value>> parse(const std::string& serialized);

 private:
  Shelf shelf_;
};

}  // namespace isofield::catalog
