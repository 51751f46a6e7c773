#include "render/view_file.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "isofield/scene_file.h"
#include "json_output.h"
#include "nearest_name.h"
#include "output_file.h"

namespace isofield {
namespace {

using google::protobuf::ListValue;
using google::protobuf::Struct;
using google::protobuf::Value;

const std::vector<std::string>& keys() {
  static const auto* const kKeys =
      new std::vector<std::string>{"target", "distance", "direction", "up", "field_of_view"};
  return *kKeys;
}

bool read_number(const Value& value, double& out) {
  out = value.number_value();
  return value.has_number_value() && std::isfinite(out);
}

bool read_vector(const Value& value, glm::dvec3& out) {
  if (value.list_value().values_size() != 3) return false;
  for (int i = 0; i < 3; ++i) {
    if (!read_number(value.list_value().values(i), out[i])) return false;
  }
  return true;
}

absl::StatusOr<View> read_view(const Struct& object) {
  View view;
  for (const auto& [key, value] : object.fields()) {
    if (std::find(keys().begin(), keys().end(), key) != keys().end()) continue;
    return absl::InvalidArgumentError(absl::StrCat("no such field \"", key.substr(0, 60), "\"",
                                                   did_you_mean(key, keys()), "; expected ",
                                                   absl::StrJoin(keys(), ", ")));
  }
  for (const std::string& key : keys()) {
    const auto found = object.fields().find(key);
    if (found == object.fields().end()) {
      return absl::InvalidArgumentError(absl::StrCat(key, " is missing; expected ", absl::StrJoin(keys(), ", ")));
    }
    bool is_good = true;
    if (key == "distance") {
      is_good = read_number(found->second, view.distance.emplace());
    } else if (key == "field_of_view") {
      is_good = read_number(found->second, view.field_of_view);
    } else {
      is_good = read_vector(found->second, key == "target"      ? view.target.emplace()
                                           : key == "direction" ? view.direction
                                                                : view.up);
    }
    if (!is_good) {
      const bool is_number = key == "distance" || key == "field_of_view";
      return absl::InvalidArgumentError(
          absl::StrCat(key, ": expected ", is_number ? "a finite number" : "3 finite numbers, such as [0, 1, 0]"));
    }
  }
  const std::string fault = view_fault(view);
  if (!fault.empty()) return absl::InvalidArgumentError(fault);
  return view;
}

std::vector<double> list(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

std::string view_fault(const View& view) {
  constexpr double kMost = 1e30;
  for (const auto& [name, vector] : {std::pair("direction", view.direction), std::pair("up", view.up)}) {
    if (!(glm::length(vector) > 1e-30 && glm::length(vector) < kMost)) {
      return absl::StrCat(name, " = [", absl::StrJoin(list(vector), ", "),
                          "]: expected a direction of any length but 0");
    }
  }
  const double across = glm::length(glm::cross(view.direction, view.up));
  if (!(across > 1e-6 * glm::length(view.direction) * glm::length(view.up))) {
    return absl::StrCat("up = [", absl::StrJoin(list(view.up), ", "),
                        "]: expected a direction that is not parallel to the view's, [",
                        absl::StrJoin(list(view.direction), ", "), "]");
  }
  if (!(view.field_of_view >= 1 && view.field_of_view <= 150)) {
    return absl::StrCat("field_of_view = ", view.field_of_view, ": expected degrees within [1, 150]");
  }
  if (view.distance && !(*view.distance > 1e-30 && *view.distance < kMost)) {
    return absl::StrCat("distance = ", *view.distance, ": expected a length above 0");
  }
  return "";
}

absl::StatusOr<std::optional<View>> read_view_file(const std::string& path) {
  const auto text = read_file(path);
  if (absl::IsNotFound(text.status())) return std::nullopt;
  if (!text.ok()) return text.status();
  Struct object;
  const auto parsed = google::protobuf::util::JsonStringToMessage(*text, &object);
  if (!parsed.ok()) {
    // Only the first of the message's three lines is repeated; the others point into the text.
    const std::string reason = parsed.message().ToString();
    return absl::InvalidArgumentError(absl::StrCat(path, ": not a view in JSON: ", reason.substr(0, reason.find('\n')),
                                                   "; correct it, or delete it to start again"));
  }
  auto view = read_view(object);
  if (!view.ok()) return absl::InvalidArgumentError(absl::StrCat(path, ": ", view.status().message()));
  return *std::move(view);
}

absl::Status write_view_file(const std::string& path, const View& view) {
  JsonObject object;
  object.set("target", list(view.target.value_or(glm::dvec3(0))))
      .set("distance", view.distance.value_or(1))
      .set("direction", list(view.direction))
      .set("up", list(view.up))
      .set("field_of_view", view.field_of_view);
  auto file = OutputFile::create(path);
  if (!file.ok()) return file.status();
  absl::Status status = (*file)->write(object.text() + "\n");
  if (status.ok()) status = (*file)->commit();
  return status;
}

}  // namespace isofield
