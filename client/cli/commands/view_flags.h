#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "render/camera.h"

namespace CLI {
class App;
}

namespace isofield {

// The options that say from where a picture is taken, and the file that keeps it.
class ViewFlags {
 public:
  void add_to(CLI::App& command);

  // What the file keeps, where there is one, with what the options say instead. Errors of the file are a file's, others
  // of usage.
  absl::StatusOr<View> view() const;
  // Writes the view that a picture was taken from into the file, where one is named and holds another.
  absl::Status keep(const View& view) const;

 private:
  std::string file_, side_;
  std::optional<double> azimuth_, elevation_, distance_, field_of_view_;
  std::vector<double> target_, up_;
};

}  // namespace isofield
