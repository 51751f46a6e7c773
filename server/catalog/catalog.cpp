#include "catalog/catalog.h"

#include <absl/strings/str_cat.h>

#include "base/quoted.h"
#include "catalog/name.h"

namespace isofield::catalog {
absl::Status Catalog::not_found(const std::string& name) const {
  const std::string there = list_names(scenes_);
  return absl::NotFoundError(absl::StrCat("no scene is named ", base::quoted(name), "; ",
                                          there.empty() ? "the catalog is empty" : absl::StrCat("there are ", there)));
}

absl::StatusOr<Catalog::Put> Catalog::put(const std::string& name, v1::Scene scene,
                                          std::shared_ptr<const blobtree::OperatorTable> operators,
                                          const Condition& condition) {
  if (absl::Status s = check_name(name); !s.ok()) return s;
  auto stored = std::make_shared<const v1::Scene>(std::move(scene));
  const std::lock_guard lock(mutex_);
  const auto it = scenes_.find(name);
  if (condition.must_be_absent && it != scenes_.end()) {
    return absl::AlreadyExistsError(absl::StrCat("scene '", name, "' exists already, at version ", it->second.version));
  }
  if (condition.version != 0) {
    if (it == scenes_.end()) return not_found(name);
    if (it->second.version != condition.version) {
      return absl::AbortedError(absl::StrCat("scene '", name, "' is at version ", it->second.version, ", not at ",
                                             condition.version, "; read it again"));
    }
  }
  if (it == scenes_.end() && scenes_.size() >= max_scenes_) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the catalog holds ", scenes_.size(), " scenes, all that are admitted; delete one first"));
  }
  Put put;
  put.replaced_version = it == scenes_.end() ? 0 : it->second.version;
  put.entry = {name, ++last_version_, std::move(stored), std::move(operators)};
  scenes_[name] = put.entry;
  return put;
}

absl::StatusOr<Entry> Catalog::get(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto it = scenes_.find(name);
  if (it == scenes_.end()) return not_found(name);
  return it->second;
}

std::vector<Entry> Catalog::list(const std::string& after) const {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> entries;
  for (auto it = scenes_.upper_bound(after); it != scenes_.end(); ++it) entries.push_back(it->second);
  return entries;
}

absl::StatusOr<std::uint64_t> Catalog::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto it = scenes_.find(name);
  if (it == scenes_.end()) return not_found(name);
  const std::uint64_t version = it->second.version;
  scenes_.erase(it);
  return version;
}

}  // namespace isofield::catalog
