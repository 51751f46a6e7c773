// A build tool that writes a text of code_texts.h to the standard output: codes, leaves or operators
// (shaders/CMakeLists.txt).
#include <cstdio>
#include <string_view>

#include "generators/code_texts.h"

int main(int argc, char** argv) {
  using namespace isofield;
  const std::string_view wanted = argc == 2 ? argv[1] : "";
  std::string text;
  if (wanted == "codes") text = shaders::codes_text(blobtree::kOperands, operators::kOpcodes);
  if (wanted == "leaves") text = shaders::leaves_text(blobtree::kOperands);
  if (wanted == "operators") text = shaders::operators_text(operators::kOpcodes);
  if (text.empty()) return std::fputs("usage: isofield_write_codes codes|leaves|operators\n", stderr), 2;
  return std::fputs(text.c_str(), stdout) < 0 ? 1 : 0;
}
