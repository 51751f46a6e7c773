#include "importers/detect.h"

#include <absl/container/flat_hash_set.h>
#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "gzip.h"
#include "importers/foreign_files.h"
#include "importers/text.h"
#include "json_text.h"
#include "tables/number.h"
#include "tables/swc_row.h"
#include "tables/table_head.h"

namespace isofield {
namespace {

// How many bytes and rows of a text are looked at. PDB files may have longer headers, but their first line tells the
// format.
constexpr std::size_t kLookedAt = 1 << 16;
constexpr std::size_t kRowsLookedAt = 200;

absl::Status refuse(const std::string& name, absl::string_view what) {
  return absl::InvalidArgumentError(
      absl::StrCat(name, ": ", what,
                   "; expected a scene (.json, .pb), a neuron (.swc), a molecule (.pdb, .ent, .cif, .xyz) "
                   "or points, one \"x y z\" a line (.xyz, .txt, .csv)"));
}

bool is_text(absl::string_view bytes) {
  // Some old systems end texts with the byte 0x1A.
  return std::none_of(bytes.begin(), bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && !absl::ascii_isspace(code) && code != 0x1A) || code == 0x7F;
  });
}

// A binary STL file has 80 bytes of any text, a count, and 50 bytes for each triangle.
bool is_binary_stl(const std::string& content) {
  std::uint32_t triangles = 0;
  if (content.size() < 84) return false;
  std::memcpy(&triangles, &content[80], 4);
  return content.size() == 84 + 50 * std::uint64_t{triangles};
}

// Few texts parse as a message by accident, and those that do have fields that no scene has.
bool is_scene_message(const std::string& content) {
  v1::Scene scene;
  if (!scene.ParseFromString(content)) return false;
  if (scene.nodes_size() == 0) return content.empty();
  return scene.GetReflection()->GetUnknownFields(scene).empty() &&
         scene.nodes(0).GetReflection()->GetUnknownFields(scene.nodes(0)).empty();
}

bool is_number(absl::string_view field) {
  return parse_double(field).has_value();
}

bool are_numbers(const std::vector<absl::string_view>& fields, std::size_t first, std::size_t count) {
  return fields.size() >= first + count &&
         std::all_of(fields.begin() + first, fields.begin() + first + count, is_number);
}

bool is_pdb_record(absl::string_view line) {
  for (const char* const record : {"ATOM  ", "HETATM"}) {
    // Coordinates are in columns 31 to 54.
    if (absl::StartsWith(line, record)) return line.size() >= 54;
  }
  for (const char* const record : {"HEADER", "TITLE ", "COMPND", "SOURCE", "KEYWDS", "EXPDTA", "AUTHOR", "REVDAT",
                                   "REMARK", "CRYST1", "MODEL ", "SEQRES", "OBSLTE", "SPLIT ", "CAVEAT", "NUMMDL"}) {
    if (absl::StartsWith(line, record)) return true;
  }
  return false;
}

// Tells molecules from points that follow a count: XYZ has "count, comment, lines of: element x y z", and Tinker has
// "count title, lines of: index element x y z ...". Returns nothing where the text begins with no count or holds
// points.
std::optional<FileKind> kind_by_count(absl::string_view text) {
  LineReader lines(text);
  absl::string_view count, second, third;
  do {
    if (!lines.next(count)) return std::nullopt;
  } while (count.empty());
  const auto fields = split_fields(count);
  if (fields.empty() || !parse_integer(fields[0]) || !lines.next(second)) return std::nullopt;
  const auto names_element = [](absl::string_view field) {
    return absl::ascii_isalpha(static_cast<unsigned char>(field[0]));
  };
  const auto is_tinker = [&](absl::string_view text_line) {
    const auto atom = split_fields(text_line);
    return atom.size() >= 6 && parse_integer(atom[0]) && names_element(atom[1]) && are_numbers(atom, 2, 4);
  };
  const bool has_third = lines.next(third);
  // A line with the edges of a periodic box may come first.
  if (is_tinker(second) || (has_third && is_tinker(third))) return FileKind::kXyz;
  // Words or a blank line may follow the count, provided that an atom follows the comment.
  const auto is_atom = [&](absl::string_view text_line) {
    const auto atom = split_fields(text_line);
    return !atom.empty() && names_element(atom[0]) && are_numbers(atom, 1, 3);
  };
  if (fields.size() == 1 || !is_number(fields[1])) {
    absl::string_view fourth;
    if (is_atom(third) || (second.empty() && lines.next(fourth) && is_atom(fourth))) return FileKind::kXyz;
  }
  if (fields.size() > 1) return std::nullopt;
  if (!has_third) return FileKind::kXyz;
  const auto element = split_fields(third);
  // Elements may be numbers, and columns may come in another order. Points have numbers in their second line too.
  if (element.size() >= 4 && (!is_number(element[0]) || !are_numbers(split_fields(second), 0, 3)))
    return FileKind::kXyz;
  return std::nullopt;
}

// Returns true where most lines are samples of different ids, one of which is a root and most of which have a known
// parent.
bool is_swc(absl::string_view text) {
  LineReader lines(text);
  absl::string_view line;
  absl::flat_hash_set<absl::string_view> ids;
  std::vector<SwcRow> samples;
  std::size_t others = 0;
  while (samples.size() + others < kRowsLookedAt && lines.next(line)) {
    if (is_comment(line)) continue;
    const auto sample = swc_row(line);
    if (!sample || !ids.insert(sample->id).second) {
      ++others;
    } else {
      samples.push_back(*sample);
    }
  }
  // Parents may come after the part that is looked at, and files may hold some damaged lines.
  std::size_t linked = 0;
  for (const SwcRow& sample : samples) linked += sample.is_root || ids.contains(sample.parent) ? 1 : 0;
  const bool has_root =
      std::any_of(samples.begin(), samples.end(), [](const SwcRow& sample) { return sample.is_root; });
  return !samples.empty() && 4 * others <= samples.size() && 2 * linked > samples.size() &&
         (has_root || samples.size() == kRowsLookedAt);
}

bool has_points(absl::string_view text) {
  LineReader lines(text);
  TableHead head;
  absl::string_view line;
  for (std::size_t rows = 0; rows < kRowsLookedAt && lines.next(line);) {
    if (rows == 0 && !head.take(line)) continue;
    if (is_comment(line)) continue;
    ++rows;
    std::size_t numbers = 0;
    for (const absl::string_view cell : split_cells(line, head.separator())) {
      if (cell_number(cell, ';')) ++numbers;
    }
    if (numbers >= 3) return true;
  }
  // A header without rows is a table of no points.
  return !head.names().empty() && find_vector(head.names(), VectorRole::kPosition).ok();
}

std::optional<FileKind> kind_by_text(absl::string_view text) {
  LineReader lines(text);
  absl::string_view line;
  while (lines.next_raw(line) && is_comment(line)) {
  }
  if (absl::StartsWithIgnoreCase(line, "data_")) return FileKind::kMmcif;
  if (is_pdb_record(line)) return FileKind::kPdb;
  if (const auto kind = kind_by_count(text)) return kind;
  if (is_swc(text)) return FileKind::kSwc;
  return std::nullopt;
}

// mmCIF in JSON is an object whose first key is a data block, "data_NAME".
bool is_mmjson(absl::string_view json) {
  json.remove_prefix(std::min(json.find('{') + 1, json.size()));
  return absl::StartsWith(absl::StripLeadingAsciiWhitespace(json), "\"data_");
}

FileKind kind_of(ImportFormat format) {
  switch (format) {
    case ImportFormat::kSwc:
      return FileKind::kSwc;
    case ImportFormat::kPdb:
      return FileKind::kPdb;
    case ImportFormat::kMmcif:
      return FileKind::kMmcif;
    case ImportFormat::kXyz:
      return FileKind::kXyz;
    case ImportFormat::kPoints:
      break;
  }
  return FileKind::kPoints;
}

}  // namespace

absl::StatusOr<FileKind> detect_kind(const std::string& content, const std::string& path) {
  const std::string name(unpacked_name(path));
  if (is_json(content)) return is_mmjson(content) ? FileKind::kMmcif : FileKind::kSceneJson;
  const bool is_named_message = absl::EndsWithIgnoreCase(name, ".pb");
  const absl::string_view start = absl::string_view(content).substr(0, kLookedAt);
  if (content.empty() && !is_named_message) return refuse(path, "the file is empty");
  if (const auto what = foreign_file(start); !what.empty()) return refuse(path, what);
  if (is_named_message || !is_text(start)) {
    if (is_scene_message(content)) return FileKind::kSceneMessage;
    if (is_binary_stl(content)) return refuse(path, "an STL mesh");
  }
  const auto by_name = import_format(name);
  if (!is_text(start.substr(0, 4096))) {
    return refuse(path, is_named_message ? "not a binary isofield.v1.Scene message" : "binary data of an unknown kind");
  }
  if (const auto kind = kind_by_text(start)) return *kind;
  if (const auto what = foreign_text(start); !what.empty()) return refuse(path, what);
  // The reader of a molecule or a neuron can say best what is wrong with a file of its name. A .xyz file may hold
  // points.
  if (by_name && by_name != ImportFormat::kXyz) return kind_of(*by_name);
  if (has_points(start)) return FileKind::kPoints;
  if (by_name) return kind_of(*by_name);
  if (absl::EndsWithIgnoreCase(name, ".json")) return FileKind::kSceneJson;
  return refuse(path, "its format cannot be recognised");
}

}  // namespace isofield
