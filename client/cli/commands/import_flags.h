#pragma once

#include <string>

#include "isofield/import.h"

namespace CLI {
class App;
}

namespace isofield {

// The options of every command that may import a file on the fly.
struct ImportFlags {
  std::string op = "camel";
  ImportOptions options;

  void add_to(CLI::App& command);
  // After parsing.
  ImportOptions get() const;
};

}  // namespace isofield
