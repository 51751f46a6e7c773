#include "isofield/import.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <array>
#include <utility>

#include "gzip.h"
#include "importers/detect.h"
#include "importers/formats.h"
#include "importers/import_options.h"
#include "isofield/scene_file.h"
#include "json_text.h"

namespace isofield {
namespace {

// Returns the importer of a kind of file, or nothing for scenes, which need none.
std::optional<ImportFormat> format_of(FileKind kind) {
  switch (kind) {
    case FileKind::kSceneJson:
    case FileKind::kSceneMessage:
      break;
    case FileKind::kSwc:
      return ImportFormat::kSwc;
    case FileKind::kPdb:
      return ImportFormat::kPdb;
    case FileKind::kMmcif:
      return ImportFormat::kMmcif;
    case FileKind::kXyz:
      return ImportFormat::kXyz;
    case FileKind::kPoints:
      return ImportFormat::kPoints;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImportFormat> import_format(const std::string& path) {
  const absl::string_view name = unpacked_name(path);
  constexpr std::array<std::pair<const char*, ImportFormat>, 8> kExtensions = {{{".swc", ImportFormat::kSwc},
                                                                                {".eswc", ImportFormat::kSwc},
                                                                                {".pdb", ImportFormat::kPdb},
                                                                                {".ent", ImportFormat::kPdb},
                                                                                {".cif", ImportFormat::kMmcif},
                                                                                {".mmcif", ImportFormat::kMmcif},
                                                                                {".xyz", ImportFormat::kXyz},
                                                                                {".txt", ImportFormat::kPoints}}};
  for (const auto& [extension, format] : kExtensions) {
    if (absl::EndsWithIgnoreCase(name, extension)) return format;
  }
  return std::nullopt;
}

std::optional<ImportOperator> import_operator(const std::string& name) {
  constexpr std::array<std::pair<const char*, ImportOperator>, 6> kNames = {{{"camel", ImportOperator::kCamel},
                                                                             {"organic", ImportOperator::kOrganic},
                                                                             {"contact", ImportOperator::kContact},
                                                                             {"sum", ImportOperator::kSum},
                                                                             {"max", ImportOperator::kMax},
                                                                             {"ricci", ImportOperator::kRicci}}};
  for (const auto& [known, op] : kNames) {
    if (name == known) return op;
  }
  return std::nullopt;
}

absl::StatusOr<Imported> import_text(const std::string& text, ImportFormat format, const ImportOptions& options,
                                     const std::string& name) {
  if (auto status = check(options); !status.ok()) return status;
  Imported imported;
  absl::Status status;
  switch (format) {
    case ImportFormat::kSwc:
      status = import_swc(text, options, imported);
      break;
    case ImportFormat::kPdb:
      status = import_pdb(text, options, imported);
      break;
    case ImportFormat::kMmcif:
      status = import_mmcif(text, options, imported);
      break;
    case ImportFormat::kXyz:
      status = import_xyz(text, options, imported);
      break;
    case ImportFormat::kPoints:
      status = import_points(text, options, imported);
      break;
  }
  if (status.ok() && imported.scene.nodes_size() == 0) {
    status = absl::InvalidArgumentError("nothing in it could be used");
  }
  if (!status.ok()) {
    return absl::Status(status.code(), absl::StrCat(name, ": ", status.message(), "\n", imported.report.text()));
  }
  imported.report.pieces = find_pieces(imported.scene).size();
  if (!options.unit.empty()) imported.scene.set_unit(options.unit);
  join_pieces(options.op, imported.scene);
  const std::size_t slash = name.rfind('/');
  imported.scene.set_description(
      absl::StrCat(imported.report.format, " from ", slash == std::string::npos ? name : name.substr(slash + 1)));
  return imported;
}

absl::StatusOr<LoadedScene> load_scene_file(const std::string& path, const ImportOptions& options) {
  const auto content = read_file(path);
  if (!content.ok()) return content.status();
  const auto kind = detect_kind(*content, path);
  if (!kind.ok()) return kind.status();
  const auto format = format_of(*kind);
  if (!format) {
    LoadedScene loaded;
    absl::Status status;
    if (*kind == FileKind::kSceneJson) {
      status = parse_json(*content, path, "a scene", loaded.scene);
    } else if (!loaded.scene.ParseFromString(*content)) {
      status = absl::InvalidArgumentError(absl::StrCat(path, ": not a binary isofield.v1.Scene message"));
    }
    if (!status.ok()) return status;
    return loaded;
  }
  auto imported = import_text(*content, *format, options, path);
  if (!imported.ok()) return imported.status();
  return LoadedScene{std::move(imported->scene), std::move(imported->report)};
}

absl::StatusOr<Imported> import_file(const std::string& path, const ImportOptions& options) {
  auto loaded = load_scene_file(path, options);
  if (!loaded.ok()) return loaded.status();
  if (!loaded->report) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": already a scene; expected a neuron, a molecule or points to import"));
  }
  return Imported{std::move(loaded->scene), *std::move(loaded->report)};
}

}  // namespace isofield
