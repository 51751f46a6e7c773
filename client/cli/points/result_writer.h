#pragma once

#include <absl/status/status.h>

#include <memory>
#include <span>
#include <string>

#include "output_file.h"

namespace isofield {

// Writes the results of an evaluation as they arrive. Single-threaded.
class ResultWriter {
 public:
  virtual ~ResultWriter() = default;

  // xyz: [n, 3]; results: [n, 1], or [n, 4] with gradients.
  virtual absl::Status write(std::span<const float> xyz, std::span<const float> results) = 0;
  // After the last results; does not commit the file.
  virtual absl::Status finish() = 0;
};

// By the name: *.npy is a NumPy array float32 [n, 1] or [n, 4] of the results alone; anything else text
// "x,y,z,value[,gx,gy,gz]" with a header, nine significant digits each, which give the float32 back to the bit.
std::unique_ptr<ResultWriter> make_result_writer(const std::string& path, bool gradient, OutputFile& file);

}  // namespace isofield
