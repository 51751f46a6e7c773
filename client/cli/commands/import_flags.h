#pragma once

#include <string>

#include "commands/command_line.h"
#include "isofield/import.h"

namespace isofield {

// The options of every command that may import a file on the fly.
struct ImportFlags {
  std::string op = "camel";
  ImportOptions options;

  void add_to(Command command);
  // After parsing.
  ImportOptions get() const;
};

}  // namespace isofield
