#pragma once

#include <absl/status/status.h>

#include <memory>
#include <span>
#include <string>

#include "output_file.h"

namespace isofield {

// Writes the results of an evaluation as they arrive. It is single-threaded.
class ResultWriter {
 public:
  virtual ~ResultWriter() = default;

  // Writes results at n points: `xyz` has the shape [n, 3], `results` [n, 1] or, with gradients, [n, 4].
  virtual absl::Status write(std::span<const float> xyz, std::span<const float> results) = 0;
  // Completes the file after the last results, and does not commit it.
  virtual absl::Status finish() = 0;
};

// Makes a writer for the format that the name tells: *.npy is a NumPy array float32 [n, 1] or [n, 4] of the results
// alone; anything else is text "x,y,z,value[,gx,gy,gz]" with a header and nine significant digits, which give a float32
// back to the bit. The writer refers to `file`, which must outlive it.
std::unique_ptr<ResultWriter> make_result_writer(const std::string& path, bool gradient, OutputFile& file);

}  // namespace isofield
