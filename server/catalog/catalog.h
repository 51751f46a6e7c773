// Scenes by name and version.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catalog/scene_operators.h"
#include "catalog/shelf.h"
#include "catalog/store.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::catalog {

// A scene as it was put or edited; immutable.
struct Entry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Scene> scene;
  std::shared_ptr<const SceneOperators> operators;
};

// Thread-safe.
class Catalog {
 public:
  // `store` must outlive this.
  Catalog(Store& store, std::uint64_t max_scenes);

  struct Put {
    Entry entry;
    std::uint64_t replaced_version = 0;  // 0: none
  };
  // INVALID_ARGUMENT: the name is not allowed. ALREADY_EXISTS, NOT_FOUND, ABORTED: the condition does not hold.
  // RESOURCE_EXHAUSTED: the catalog is full.
  absl::StatusOr<Put> put(const std::string& name, v1::Scene scene, std::shared_ptr<const SceneOperators> operators,
                          const Condition& condition);
  // NOT_FOUND: there is no such scene; the message lists the names that there are.
  absl::StatusOr<Entry> get(const std::string& name) const;
  // At most `most` scenes, in the order of their names, from the first name after `after` on.
  absl::StatusOr<std::vector<Entry>> list(const std::string& after, std::size_t most) const;
  // Returns the version that is removed. NOT_FOUND: there is no such scene.
  absl::StatusOr<std::uint64_t> remove(const std::string& name);

  // Reads scenes for a store that keeps them as bytes.
  static absl::StatusOr<std::shared_ptr<const Value>> parse(const std::string& serialized);

 private:
  Shelf shelf_;
};

}  // namespace isofield::catalog
