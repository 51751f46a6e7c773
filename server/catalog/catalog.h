// The catalog of scenes: it stores, finds, lists and removes them by name, and gives each change a new version.
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

// One version of a scene, as it was put or edited. It is immutable.
struct Entry {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const v1::Scene> scene;
  std::shared_ptr<const SceneOperators> operators;
};

// Keeps scenes in a Store and words the errors that clients see. Thread-safe.
class Catalog {
 public:
  // `store` must outlive this.
  Catalog(Store& store, std::uint64_t max_scenes);

  struct Put {
    Entry entry;
    std::uint64_t replaced_version = 0;  // 0: none
  };
  // Stores a scene under a new version, and replaces the one of the same name if there is one. INVALID_ARGUMENT: the
  // name is not allowed. ALREADY_EXISTS, NOT_FOUND, ABORTED: the condition does not hold. RESOURCE_EXHAUSTED: the
  // catalog is full.
  absl::StatusOr<Put> put(const std::string& name, v1::Scene scene, std::shared_ptr<const SceneOperators> operators,
                          const Condition& condition);
  // NOT_FOUND: there is no such scene; the message lists up to ten of the names that there are.
  absl::StatusOr<Entry> get(const std::string& name) const;
  // Returns at most `most` scenes, in the order of their names, from the first name after `after` on.
  absl::StatusOr<std::vector<Entry>> list(const std::string& after, std::size_t most) const;
  // Returns the version that is removed. NOT_FOUND: there is no such scene.
  absl::StatusOr<std::uint64_t> remove(const std::string& name);

  // Reads a scene from its serialized form, for a store that keeps bytes. DATA_LOSS: the bytes are broken.
  static absl::StatusOr<std::shared_ptr<const Value>> parse(const std::string& serialized);

 private:
  Shelf shelf_;
};

}  // namespace isofield::catalog
