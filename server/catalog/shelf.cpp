#include "catalog/shelf.h"

#include <absl/strings/str_cat.h>

#include <utility>

#include "base/status_macros.h"
#include "catalog/name.h"

namespace isofield::catalog {
namespace {

// An error lists at most this many names.
constexpr std::size_t kMostNames = 10;

}  // namespace

absl::StatusOr<Shelf::Put> Shelf::put(const std::string& name, std::shared_ptr<const Value> value,
                                      const Condition& condition) {
  ISOFIELD_RETURN_IF_ERROR(check_name(name));
  ISOFIELD_ASSIGN_OR_RETURN(const Store::Put put, store_.put(kind_, name, value, condition, quota_));
  if (put.outcome != Store::Put::Outcome::kDone) return refusal(name, condition, put);
  return Put{{name, put.version, std::move(value)}, put.found};
}

absl::StatusOr<Record> Shelf::get(const std::string& name) const {
  ISOFIELD_ASSIGN_OR_RETURN(std::vector<std::optional<Record>> found, store_.get(kind_, std::span(&name, 1)));
  if (!found.front()) return not_found(name);
  return *std::move(found.front());
}

absl::StatusOr<std::vector<std::optional<Record>>> Shelf::get_all(std::span<const std::string> names) const {
  return store_.get(kind_, names);
}

absl::StatusOr<std::vector<Record>> Shelf::list(const std::string& after, std::size_t most) const {
  return store_.list(kind_, after, most);
}

absl::StatusOr<Record> Shelf::remove(const std::string& name) {
  ISOFIELD_ASSIGN_OR_RETURN(std::optional<Record> removed, store_.remove(kind_, name));
  if (!removed) return not_found(name);
  return *std::move(removed);
}

absl::StatusOr<std::string> Shelf::names() const {
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<Record> first, store_.list(kind_, "", kMostNames + 1));
  std::string names;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (i == kMostNames) return names + ", ...";
    absl::StrAppend(&names, i > 0 ? ", '" : "'", first[i].name, "'");
  }
  return names;
}

absl::Status Shelf::not_found(const std::string& name) const {
  ISOFIELD_ASSIGN_OR_RETURN(const std::string there, names());
  return absl::NotFoundError(words_.not_found(name, there));
}

absl::Status Shelf::refusal(const std::string& name, const Condition& condition, const Store::Put& put) const {
  using Outcome = Store::Put::Outcome;
  switch (put.outcome) {
    case Outcome::kDone:
      break;
    case Outcome::kIsThere:
      return absl::AlreadyExistsError(absl::StrCat(words_.one, " '", name, "' exists already, at version ", put.found));
    case Outcome::kIsNotThere:
      return not_found(name);
    case Outcome::kIsAtAnother:
      return absl::AbortedError(absl::StrCat(words_.one, " '", name, "' is at version ", put.found, ", not at ",
                                             condition.version, "; read it again"));
    case Outcome::kTooManyEntries:
      return absl::ResourceExhaustedError(absl::StrCat("the catalog holds ", put.amount, " ", words_.many,
                                                       ", all that are admitted; delete one first"));
    case Outcome::kTooManyBytes:
      return absl::ResourceExhaustedError(absl::StrCat(
          words_.many, " would take ", put.amount, " bytes, expected at most ", quota_.bytes, "; delete one first"));
  }
  return absl::InternalError("the store gave an outcome that is none");
}

}  // namespace isofield::catalog
