#include "catalog/operator_catalog.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include "base/quoted.h"
#include "blobtree/scene/node_reader.h"
#include "catalog/built_in_operators.h"
#include "catalog/name.h"

namespace isofield::catalog {

absl::Status OperatorCatalog::not_found(const std::string& name) const {
  const std::string there = list_names(operators_);
  if (built_in_operator(name)) {
    return absl::NotFoundError(absl::StrCat("'", name, "' is a built-in operator: expected a custom one; there are ",
                                            there.empty() ? "none" : there));
  }
  return absl::NotFoundError(absl::StrCat("no operator is named ", base::quoted(name), "; there are the built-in ones ",
                                          absl::StrJoin(built_in_names(), ", "), " and ",
                                          there.empty() ? "no custom ones" : there));
}

absl::StatusOr<OperatorEntry> OperatorCatalog::put(const std::string& name, v1::Operator message,
                                                   std::shared_ptr<const operators::Operator> op) {
  if (absl::Status s = check_name(name); !s.ok()) return s;
  if (built_in_operator(name)) {
    return absl::InvalidArgumentError(
        absl::StrCat("name = '", name, "': expected a name that is no built-in operator's"));
  }
  auto stored = std::make_shared<const v1::Operator>(std::move(message));
  const std::lock_guard lock(mutex_);
  if (!operators_.contains(name) && operators_.size() >= max_operators_) {
    return absl::ResourceExhaustedError(absl::StrCat("the catalog holds ", operators_.size(),
                                                     " custom operators, all that are admitted; delete one first"));
  }
  const auto before = operators_.find(name);
  const std::uint64_t bytes =
      bytes_ + stored->ByteSizeLong() - (before == operators_.end() ? 0 : before->second.message->ByteSizeLong());
  if (bytes > kMaxOperatorBytes) {
    return absl::ResourceExhaustedError(absl::StrCat("custom operators would take ", bytes, " bytes, expected at most ",
                                                     kMaxOperatorBytes, "; delete one first"));
  }
  bytes_ = bytes;
  return operators_[name] = {name, ++last_version_, std::move(stored), std::move(op)};
}

absl::StatusOr<OperatorEntry> OperatorCatalog::get(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto it = operators_.find(name);
  if (it == operators_.end()) return not_found(name);
  return it->second;
}

std::vector<OperatorEntry> OperatorCatalog::list(const std::string& after) const {
  const std::lock_guard lock(mutex_);
  std::vector<OperatorEntry> entries;
  for (auto it = operators_.upper_bound(after); it != operators_.end(); ++it) entries.push_back(it->second);
  return entries;
}

absl::Status OperatorCatalog::remove(const std::string& name) {
  OperatorEntry last;  // declared before the lock: its samples may be the last to go, after it
  const std::lock_guard lock(mutex_);
  const auto it = operators_.find(name);
  if (it == operators_.end()) return not_found(name);
  last = std::move(it->second);
  bytes_ -= last.message->ByteSizeLong();
  operators_.erase(it);
  return absl::OkStatus();
}

std::uint64_t OperatorCatalog::size() const {
  const std::lock_guard lock(mutex_);
  return operators_.size();
}

absl::StatusOr<std::shared_ptr<const blobtree::OperatorTable>> OperatorCatalog::table_for(
    const v1::Scene& scene) const {
  auto table = std::make_shared<blobtree::OperatorTable>();
  // One moment for all of a scene's operators.
  std::unique_lock lock(mutex_, std::defer_lock);
  for (int i = 0; i < scene.nodes_size(); ++i) {
    const v1::Node& node = scene.nodes(i);
    if (!node.has_custom() || table->contains(node.custom().operator_())) continue;
    if (!lock.owns_lock()) lock.lock();
    const auto it = operators_.find(node.custom().operator_());
    if (it == operators_.end()) {
      const std::string there = list_names(operators_);
      return absl::InvalidArgumentError(
          absl::StrCat(blobtree::node_path(i, node), ".operator = ", base::quoted(node.custom().operator_()),
                       ": expected a custom operator; ",
                       there.empty() ? "there are none" : absl::StrCat("there are ", there)));
    }
    table->emplace(it->first, it->second.op);
  }
  return table;
}

}  // namespace isofield::catalog
