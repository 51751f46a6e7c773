#pragma once

#include <cstdio>
#include <memory>

namespace isofield {

// Closes all but the standard input, which is not ours.
struct CloseInput {
  void operator()(FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};
using InputFile = std::unique_ptr<FILE, CloseInput>;

}  // namespace isofield
