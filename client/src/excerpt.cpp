#include "excerpt.h"

#include <absl/strings/ascii.h>

namespace isofield {

std::string excerpt(absl::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string result(text.substr(0, kMost));
  // Control characters would act on the terminal, and the cut may leave half a UTF-8 character.
  for (char& c : result) {
    if (!absl::ascii_isprint(static_cast<unsigned char>(c))) {
      c = absl::ascii_isspace(static_cast<unsigned char>(c)) ? ' ' : '?';
    }
  }
  return text.size() > kMost ? result.replace(kMost - 3, 3, "...") : result;
}

}  // namespace isofield
