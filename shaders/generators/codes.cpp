// Writes the texts of code_texts.h at build time (shaders/CMakeLists.txt): codes FOLDER.
#include <cstdio>
#include <fstream>

#include "generators/code_texts.h"

int main(int argc, char** argv) {
  using namespace isofield;
  if (argc != 2) return std::fputs("usage: codes FOLDER\n", stderr), 2;
  const std::string folder = argv[1];
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream file(folder + "/" + name, std::ios::binary);
    file << text;
    return static_cast<bool>(file.flush());
  };
  const bool is_written = write("codes.glsl", shaders::codes_text(blobtree::kOperands, operators::kOpcodes)) &&
                          write("leaves.glsl", shaders::leaves_text(blobtree::kOperands)) &&
                          write("operators.glsl", shaders::operators_text(operators::kOpcodes));
  return is_written ? 0 : 1;
}
