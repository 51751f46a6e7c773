#include "points/point_notes.h"

#include <absl/strings/str_cat.h>

namespace isofield {

std::string unnamed_columns_note(std::size_t columns) {
  return absl::StrCat("the columns have no names: the first three of ", columns,
                      " are read as x, y, z, and the others are ignored");
}

std::vector<std::string> point_notes(const std::string& file, const std::string& note, std::size_t missed) {
  std::vector<std::string> notes;
  if (!note.empty()) notes.push_back(absl::StrCat(file, ": ", note));
  if (missed > 0) {
    notes.push_back(absl::StrCat(file, ": ", missed, missed == 1 ? " row is" : " rows are",
                                 " left out, since the distance in it is not finite: the ray hit nothing"));
  }
  return notes;
}

}  // namespace isofield
