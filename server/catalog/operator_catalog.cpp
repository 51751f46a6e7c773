#include "catalog/operator_catalog.h"

#include <absl/container/flat_hash_set.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <utility>

#include "base/quoted.h"
#include "base/status_macros.h"
#include "blobtree/scene/node_reader.h"
#include "blobtree/scene/operator_reader.h"
#include "catalog/built_in_operators.h"

namespace isofield::catalog {
namespace {

// A custom operator as the store keeps it. The serialized form is an Operator message.
class OperatorValue final : public Value {
 public:
  OperatorValue(v1::Operator message, std::shared_ptr<const operators::Operator> op)
      : message_(std::make_shared<const v1::Operator>(std::move(message))),
        op_(std::move(op)),
        bytes_(message_->ByteSizeLong()) {}

  std::string serialized() const override { return message_->SerializeAsString(); }
  std::uint64_t bytes() const override { return bytes_; }

  const std::shared_ptr<const v1::Operator>& message() const { return message_; }
  const std::shared_ptr<const operators::Operator>& op() const { return op_; }

 private:
  const std::shared_ptr<const v1::Operator> message_;
  const std::shared_ptr<const operators::Operator> op_;
  const std::uint64_t bytes_;
};

OperatorEntry operator_entry(const Record& record) {
  const auto& value = static_cast<const OperatorValue&>(*record.value);
  return {record.name, record.version, value.message(), value.op()};
}

Shelf::Words words_of_operators() {
  const auto not_found = [](const std::string& name, const std::string& there) {
    if (built_in_operator(name)) {
      return absl::StrCat("'", name, "' is a built-in operator: expected a custom one; there are ",
                          there.empty() ? "none" : there);
    }
    return absl::StrCat("no operator is named ", base::quoted(name), "; there are the built-in ones ",
                        absl::StrJoin(built_in_names(), ", "), " and ", there.empty() ? "no custom ones" : there);
  };
  return {.one = "operator", .many = "custom operators", .not_found = not_found};
}

}  // namespace

OperatorCatalog::OperatorCatalog(Store& store, std::uint64_t max_operators)
    : shelf_(store, Kind::kOperator, {.entries = max_operators, .bytes = kMaxOperatorBytes}, words_of_operators()) {}

absl::StatusOr<OperatorEntry> OperatorCatalog::put(const std::string& name, v1::Operator message,
                                                   std::shared_ptr<const operators::Operator> op) {
  if (built_in_operator(name)) {
    return absl::InvalidArgumentError(
        absl::StrCat("name = '", name, "': expected a name that is no built-in operator's"));
  }
  auto value = std::make_shared<const OperatorValue>(std::move(message), std::move(op));
  ISOFIELD_ASSIGN_OR_RETURN(const Shelf::Put put, shelf_.put(name, std::move(value)));
  return operator_entry(put.record);
}

absl::StatusOr<OperatorEntry> OperatorCatalog::get(const std::string& name) const {
  ISOFIELD_ASSIGN_OR_RETURN(const Record record, shelf_.get(name));
  return operator_entry(record);
}

absl::StatusOr<std::vector<OperatorEntry>> OperatorCatalog::list(const std::string& after, std::size_t most) const {
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<Record> records, shelf_.list(after, most));
  std::vector<OperatorEntry> entries;
  for (const Record& record : records) entries.push_back(operator_entry(record));
  return entries;
}

absl::Status OperatorCatalog::remove(const std::string& name) {
  return shelf_.remove(name).status();
}

absl::StatusOr<std::uint64_t> OperatorCatalog::size() const {
  ISOFIELD_ASSIGN_OR_RETURN(const Usage usage, shelf_.usage());
  return usage.entries;
}

absl::StatusOr<std::shared_ptr<const SceneOperators>> OperatorCatalog::operators_of(const v1::Scene& scene) const {
  auto operators = std::make_shared<SceneOperators>();
  std::vector<std::string> names;
  std::vector<int> nodes;  // the first node that uses each name
  absl::flat_hash_set<std::string> seen;
  for (int i = 0; i < scene.nodes_size(); ++i) {
    if (!scene.nodes(i).has_custom() || !seen.insert(scene.nodes(i).custom().operator_()).second) continue;
    names.push_back(scene.nodes(i).custom().operator_());
    nodes.push_back(i);
  }
  if (names.empty()) return operators;
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::optional<Record>> found, shelf_.get_all(names));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!found[i]) {
      ISOFIELD_ASSIGN_OR_RETURN(const std::string there, shelf_.names());
      return absl::InvalidArgumentError(absl::StrCat(
          blobtree::node_path(nodes[i], scene.nodes(nodes[i])), ".operator = ", base::quoted(names[i]),
          ": expected a custom operator; ", there.empty() ? "there are none" : absl::StrCat("there are ", there)));
    }
    const OperatorEntry entry = operator_entry(*found[i]);
    operators->table.emplace(names[i], entry.op);
    operators->messages.emplace(names[i], entry.message);
  }
  return operators;
}

absl::StatusOr<std::shared_ptr<const Value>> OperatorCatalog::parse(const std::string& serialized) {
  v1::Operator message;
  if (!message.ParseFromString(serialized)) return absl::DataLossError("a kept operator is broken");
  ISOFIELD_ASSIGN_OR_RETURN(auto op, blobtree::read_operator(message));
  return std::make_shared<const OperatorValue>(std::move(message), std::move(op));
}

}  // namespace isofield::catalog
