#include "importers/foreign_files.h"

#include <absl/strings/match.h>

#include <algorithm>

#include "importers/text.h"
#include "tables/number.h"

namespace isofield {
namespace {

struct Magic {
  // The length comes from the array, since the bytes may hold zeros.
  template <std::size_t N>
  constexpr Magic(const char (&text)[N], const char* what, std::size_t offset = 0)
      : bytes(text, N - 1), what(what), offset(offset) {}

  absl::string_view bytes;
  absl::string_view what;
  std::size_t offset;
};

constexpr Magic kMagics[] = {
    {"\x89PNG", "a PNG picture"},
    {"\xFF\xD8\xFF", "a JPEG picture"},
    {"GIF8", "a GIF picture"},
    {"II*\0", "a TIFF picture"},
    {"MM\0*", "a TIFF picture"},
    {"WEBP", "a WebP picture", 8},
    {"%PDF-", "a PDF document"},
    {"PK\3\4", "a ZIP archive (so are .3mf, .npz, .xlsx and .docx files)"},
    {"PK\5\6", "an empty ZIP archive"},
    {"\x1F\x8B", "a gzip archive"},
    {"BZh", "a bzip2 archive"},
    {"\xFD"
     "7zXZ",
     "an xz archive"},
    {"\x28\xB5\x2F\xFD", "a Zstandard archive"},
    {"7z\xBC\xAF", "a 7-Zip archive"},
    {"Rar!", "a RAR archive"},
    {"ustar", "a tar archive", 257},
    {"\x89HDF\r\n", "an HDF5 file"},
    {"CDF\1", "a NetCDF file"},
    {"CDF\2", "a NetCDF file"},
    {"glTF", "a GLB mesh"},
    {"\x93NUMPY", "a NumPy array"},
    {"\x7F"
     "ELF",
     "a program"},
    {"MZ\x90", "a program"},
    {"SQLite format 3", "an SQLite database"},
    {"DICM", "a DICOM picture", 128},
    {"MAP ", "a CCP4 or MRC map", 208},
    {"ply\n", "a PLY mesh"},
    {"ply\r", "a PLY mesh"},
    {"NRRD000", "an NRRD volume"},
    {"BLENDER", "a Blender file"},
    {"Kaydara FBX", "an FBX model"},
    {"\xFF\xFE", "text in UTF-16 (UTF-8 can be read)"},
    {"\xFE\xFF", "text in UTF-16 (UTF-8 can be read)"},
};

constexpr Magic kTexts[] = {
    {"# vtk DataFile", "a VTK file"}, {"SIMPLE  =", "a FITS picture"}, {"@<TRIPOS>", "a MOL2 molecule"},
    {"#VRML", "a VRML model"},        {"# .PCD", "a PCD point cloud"}, {"VERSION .7", "a PCD point cloud"},
    {"<", "XML or a web page"},
};

absl::string_view find(absl::string_view start, const Magic* begin, const Magic* end) {
  const bool has_zero = start.substr(0, 512).find('\0') != absl::string_view::npos;
  const Magic* const found = std::find_if(begin, end, [&](const Magic& magic) {
    // A text may hold these bytes by chance beyond its start; only binary files have zeros.
    if (magic.offset > 0 && (start.size() <= magic.offset || !has_zero)) return false;
    return absl::StartsWith(start.substr(magic.offset), magic.bytes);
  });
  return found == end ? absl::string_view() : found->what;
}

// Returns true for a line such as "v 1 2 3", a vertex of OBJ.
bool is_keyword_and_numbers(absl::string_view line, absl::string_view keyword) {
  const auto fields = split_fields(line);
  if (fields.size() < 4 || fields[0] != keyword) return false;
  return parse_double(fields[1]) && parse_double(fields[2]) && parse_double(fields[3]);
}

}  // namespace

absl::string_view foreign_file(absl::string_view start) {
  return find(start, std::begin(kMagics), std::end(kMagics));
}

absl::string_view foreign_text(absl::string_view start) {
  if (const auto what = find(start, std::begin(kTexts), std::end(kTexts)); !what.empty()) return what;
  LineReader lines(start);
  absl::string_view line, first;
  for (int content = 0; content < 12 && lines.next(line);) {
    // The fourth line of a MOL block states its version; the first three may be empty.
    if (lines.number() == 4 && (absl::EndsWith(line, "V2000") || absl::EndsWith(line, "V3000")))
      return "an SDF or MOL molecule";
    if (line.empty() || line.front() == '#') continue;
    ++content;
    if (first.empty()) first = line;
    if (is_keyword_and_numbers(line, "v")) return "an OBJ mesh";
    if (absl::StartsWith(line, "facet normal") && absl::StartsWith(first, "solid")) return "an STL mesh";
  }
  if (first == "OFF" || first == "COFF" || first == "NOFF") return "an OFF mesh";
  return "";
}

}  // namespace isofield
