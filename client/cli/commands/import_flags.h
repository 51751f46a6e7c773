#pragma once

#include <string>

#include "commands/command_line.h"
#include "isofield/import.h"

namespace isofield {

// The options that say how a file is imported. Every command that takes a file to import in place of a scene has them.
struct ImportFlags {
  std::string op = "camel";
  ImportOptions options;

  void add_to(Command command);
  // Returns the options; valid after the command line was parsed.
  ImportOptions get() const;
};

}  // namespace isofield
