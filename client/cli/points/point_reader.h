#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <vector>

#include "points/vector_columns.h"

namespace isofield {

// Reads points, or other vectors, in chunks, so that a file of any length needs the memory of one chunk. Only a NumPy
// array in Fortran order needs the memory of all its points. Single-threaded.
class PointReader {
 public:
  virtual ~PointReader() = default;

  // Appends the [n, 3] coordinates of the next points, n <= max_points; none at the end.
  // INVALID_ARGUMENT: the message names the file, the line (or row) and what was expected there. Coordinates that are
  // not finite are refused here, where the line is known.
  virtual absl::Status read(std::size_t max_points, std::vector<float>& xyz) = 0;

  // Sentences for the user about columns and rows that are left out, of the rows read so far.
  virtual std::vector<std::string> notes() const = 0;
};

// Opens a file of points; "-" is the standard input. A file that begins with NumPy's magic bytes is an array, whatever
// its name is. Any other file is text.
//
// The columns that hold the vectors are found so:
//  - With a header (text) or fields (NumPy's structured types): those that find_vector() chooses by their names.
//    INVALID_ARGUMENT: they are not there.
//  - Without names: the first three, with a note on the others.
// Rows whose column "distance" is not finite are left out, with a note: `isofield ray` writes them for rays that hit
// nothing.
//
// Text has one point a line. Cells are separated by commas, semicolons, tabs or blanks; decimal commas are read between
// semicolons only (tables/table_head.h). NumPy files are of versions 1 to 3, with shape (n, 3 to 64), or a structured
// type and shape (n,). Their numbers are integers or floats of any size and byte order, in C or Fortran order.
absl::StatusOr<std::unique_ptr<PointReader>> open_points(const std::string& path, const VectorColumns& wanted = {});

// The text about such files in --help.
inline constexpr char kPointsHelp[] =
    "Text with a point a line (.csv) or a NumPy array (.npy); - is the standard input. Columns or fields named x, y, "
    "z, in any order; without names the first three. Rows of `isofield ray` that hit nothing are left out";

}  // namespace isofield
