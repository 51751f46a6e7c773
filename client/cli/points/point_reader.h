#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <vector>

#include "points/vector_columns.h"

namespace isofield {

// Reads points, or other vectors, in chunks, so that a file of any length needs the memory of one chunk. Only a NumPy
// array in Fortran order needs the memory of all its points. It is single-threaded.
class PointReader {
 public:
  virtual ~PointReader() = default;

  // Appends the [n, 3] coordinates of the next points, n <= max_points; none at the end.
  // INVALID_ARGUMENT: the message names the file, the line (or row) and what was expected there. Coordinates that are
  // not finite are refused here, where the line is known.
  virtual absl::Status read(std::size_t max_points, std::vector<float>& xyz) = 0;

  // Returns sentences for the user about the columns and rows left out so far.
  virtual std::vector<std::string> notes() const = 0;
};

// Opens a file of points; "-" is the standard input. A file that begins with NumPy's magic bytes is an array, whatever
// its name is. Any other file is text.
//
// The columns that hold the vectors are found as follows:
//  - With a header (text) or fields (NumPy's structured types) find_vector() chooses them by their names.
//    INVALID_ARGUMENT: they are not there.
//  - Without names they are the first three, with a note on the others, or columns 4 to 6 (VectorColumns::is_second).
// Rows whose column "distance" is not finite are left out, with a note: `isofield ray` writes them for rays that hit
// nothing.
//
// Text has one point a line. Cells are separated by commas, semicolons, tabs or blanks; decimal commas are read between
// semicolons only (tables/table_head.h). NumPy files are of versions 1 to 3, with shape (n, 3 to 64), or a structured
// type and shape (n,). Their numbers are integers or floats of any size and byte order, in C or Fortran order.
absl::StatusOr<std::unique_ptr<PointReader>> open_points(const std::string& path, const VectorColumns& wanted = {});

// The text in --help about such files.
inline constexpr char kPointsHelp[] =
    "Text with one point per line (.csv) or a NumPy array (.npy); - is the standard input. Columns or fields named x, "
    "y, z, in any order; without names the first three. Rows of `isofield ray` that hit nothing are left out";

}  // namespace isofield
