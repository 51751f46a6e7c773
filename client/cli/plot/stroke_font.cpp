#include "plot/stroke_font.h"

#include <cctype>

namespace isofield {
namespace {

// On a grid: 0 to 4 across; up from 0 (descenders) over 2 (base line) and 6 (small letters) to 8 (digits).
constexpr double kBase = 2, kTop = 8, kAdvance = 5.6;

// Strokes between blanks, each a path through points "xy".
const char* glyph(char c) {
  switch (std::tolower(static_cast<unsigned char>(c))) {
    case '0':
      return "12 03 07 18 38 47 43 32 12";
    case '1':
      return "07 28 22";
    case '2':
      return "07 18 38 47 46 02 42";
    case '3':
      return "07 18 38 47 46 35 15|35 44 43 32 12 03";
    case '4':
      return "32 38 04 44";
    case '5':
      return "48 08 05 35 44 43 32 12 03";
    case '6':
      return "47 38 18 07 03 12 32 43 44 35 15 04";
    case '7':
      return "08 48 12";
    case '8':
      return "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35";
    case '9':
      return "03 12 32 43 47 38 18 07 06 15 35 46";
    case 'a':
      return "46 42|45 36 16 05 03 12 32 43";
    case 'b':
      return "08 02|05 16 36 45 43 32 12 03";
    case 'c':
      return "45 36 16 05 03 12 32 43";
    case 'd':
      return "48 42|45 36 16 05 03 12 32 43";
    case 'e':
      return "04 44 45 36 16 05 03 12 32 43";
    case 'f':
      return "38 28 17 12|06 36";
    case 'g':
      return "46 41 30 10 01|45 36 16 05 03 12 32 43";
    case 'h':
      return "08 02|05 16 36 45 42";
    case 'i':
      return "26 22|28 28";
    case 'j':
      return "26 21 10 00|28 28";
    case 'k':
      return "08 02|46 04 42";
    case 'l':
      return "28 22";
    case 'm':
      return "02 06|05 16 25 22|25 36 45 42";
    case 'n':
      return "02 06|05 16 36 45 42";
    case 'o':
      return "12 03 05 16 36 45 43 32 12";
    case 'p':
      return "06 00|05 16 36 45 43 32 12 03";
    case 'q':
      return "46 40|45 36 16 05 03 12 32 43";
    case 'r':
      return "06 02|04 15 26 36";
    case 's':
      return "45 36 16 05 14 34 43 32 12 03";
    case 't':
      return "18 13 22 32|06 36";
    case 'u':
      return "06 03 12 32 43|46 42";
    case 'v':
      return "06 22 46";
    case 'w':
      return "06 12 25 32 46";
    case 'x':
      return "06 42|46 02";
    case 'y':
      return "06 22|46 10 00";
    case 'z':
      return "06 46 02 42";
    case '.':
      return "22 22";
    case ',':
      return "22 11";
    case ':':
      return "22 22|25 25";
    case '-':
      return "15 35";
    case '+':
      return "05 45|27 23";
    case '=':
      return "06 46|04 44";
    case '(':
      return "38 27 23 32";
    case ')':
      return "18 27 23 12";
    case '/':
      return "02 48";
    case '_':
      return "01 41";
    default:
      return "";
  }
}

}  // namespace

double text_width(const std::string& text, double height) {
  return static_cast<double>(text.size()) * kAdvance * height / (kTop - kBase);
}

std::vector<Segment> text_strokes(const std::string& text, double x, double y, double height) {
  const double unit = height / (kTop - kBase);
  std::vector<Segment> strokes;
  for (const char c : text) {
    bool is_first = true;
    Point last;
    for (const char* at = glyph(c); *at; at += at[2] ? 3 : 2) {
      const Point point{x + (at[0] - '0') * unit, y - ((at[1] - '0') - kBase) * unit};
      if (!is_first) strokes.push_back({last, point});
      last = point;
      is_first = at[2] == '|';
    }
    x += kAdvance * unit;
  }
  return strokes;
}

}  // namespace isofield
