// Reads the numbers of a message, checks them against their limits, and words the refusals in the form
// `path.field = value: expected ...`.
#pragma once

#include <absl/status/status.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/string_view.h>
#include <google/protobuf/repeated_field.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "base/limits.h"

namespace isofield::base {

// Collects the first refusal (INVALID_ARGUMENT) while fields are read one by one; the caller asks for status() at the
// end. A field that is in order builds no text, since texts would take much of the time in which a large scene is read.
class FieldReader {
 public:
  using Numbers = google::protobuf::RepeatedField<double>;

  // Errors name the message by `path`, which must outlive the reader.
  explicit FieldReader(const std::string& path) : path_(path) {}

  absl::Status status() const { return status_; }

  void refuse(absl::string_view field, absl::string_view value, absl::string_view expected) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(path_, ".", field, " = ", value, ": expected ", expected));
  }

  // Refuses a field that is left out. It is for fields of which the message can tell that they are left out.
  void miss(absl::string_view field, absl::string_view expected) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(path_, ".", field, " is missing: expected ", expected));
  }
  // Refuses a number. One that is left out arrives as 0, so the error for 0 speaks of both.
  void refuse_number(absl::string_view field, double value, absl::string_view expected) {
    if (!status_.ok()) return;
    if (value != 0) return refuse(field, absl::StrCat(value), expected);
    status_ = absl::InvalidArgumentError(absl::StrCat(path_, ".", field, " is missing or 0: expected ", expected));
  }

  // Refuses a list by its number of elements. An empty list cannot be told from one that is left out.
  void refuse_count(absl::string_view field, int count, absl::string_view expected) {
    count == 0 ? miss(field, expected) : refuse(field, absl::StrCat("[", count, " numbers]"), expected);
  }

  // Returns the number, and refuses it unless it lies within [least, most]. The functions below do likewise.
  double number(absl::string_view field, double value, double least, double most, absl::string_view expected) {
    if (!(value >= least && value <= most)) refuse(field, absl::StrCat(value), expected);
    return value;
  }
  // Checks a number without a default. The message cannot tell whether it is stated.
  double required_number(absl::string_view field, double value, double least, double most, absl::string_view expected) {
    if (!(value >= least && value <= most)) refuse_number(field, value, expected);
    return value;
  }
  // Checks a length > 0, within [kMinLength, kMaxCoordinate]. `component`, such as ".x", is appended to the field's
  // name.
  double positive(absl::string_view field, double value, absl::string_view component = "") {
    if (!(value >= kMinLength && value <= kMaxCoordinate)) {
      const std::string expected = absl::StrCat("a length > 0, within [", kMinLength, ", ", kMaxCoordinate, "]");
      // A component cannot be missing where the vector is there.
      if (component.empty()) return refuse_number(field, value, expected), value;
      refuse(absl::StrCat(field, component), absl::StrCat(value), expected);
    }
    return value;
  }
  double coordinate(absl::string_view field, double value, absl::string_view component = "") {
    if (!(value >= -kMaxCoordinate && value <= kMaxCoordinate)) {
      refuse(absl::StrCat(field, component), absl::StrCat(value),
             absl::StrCat("a finite number of magnitude at most ", kMaxCoordinate));
    }
    return value;
  }
  glm::dvec3 point(absl::string_view field, const Numbers& numbers, const glm::dvec3& otherwise = {}) {
    return has_size(field, numbers, 3, true) ? stated_point(field, numbers) : otherwise;
  }
  // Reads a point that has no default.
  glm::dvec3 stated_point(absl::string_view field, const Numbers& numbers) {
    if (!has_size(field, numbers, 3, false)) return {};
    return {coordinate(field, numbers[0], ".x"), coordinate(field, numbers[1], ".y"),
            coordinate(field, numbers[2], ".z")};
  }
  // Reads a direction, which may have any length but 0.
  glm::dvec3 direction(absl::string_view field, const Numbers& numbers, const glm::dvec3& otherwise) {
    const glm::dvec3 v = point(field, numbers, otherwise);
    if (!(length(v) > 0)) refuse(field, "(0, 0, 0)", "a direction of a length that is not 0");
    return v;
  }
  glm::dvec3 lengths(absl::string_view field, const Numbers& numbers) {
    if (!has_size(field, numbers, 3, false)) return {1, 1, 1};
    return {positive(field, numbers[0], ".x"), positive(field, numbers[1], ".y"), positive(field, numbers[2], ".z")};
  }
  // Returns false when the list is empty and the default is meant, or when the number of its elements is refused.
  bool has_size(absl::string_view field, const Numbers& numbers, int size, bool may_be_empty) {
    if (numbers.empty() && may_be_empty) return false;
    if (numbers.size() == size) return true;
    refuse_count(field, numbers.size(), absl::StrCat(size, " numbers"));
    return false;
  }

 private:
  const std::string& path_;
  absl::Status status_;
};

}  // namespace isofield::base
