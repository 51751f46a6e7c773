#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "commands/command_line.h"
#include "render/camera.h"

namespace isofield {

// The options that say from where a picture is taken. One of them names a file that keeps the view between pictures.
class ViewFlags {
 public:
  void add_to(Command command);

  // Returns the view of the file, if there is one, with the options overriding it. Faults of the file are file errors,
  // other faults are errors of usage.
  absl::StatusOr<View> view() const;
  // Writes the view of a picture into the file. Does nothing if no file is named or it holds this view already.
  absl::Status keep(const View& view) const;

 private:
  std::string file_, side_;
  std::optional<double> azimuth_, elevation_, distance_, field_of_view_;
  std::vector<double> target_, up_;
};

}  // namespace isofield
