#include "isofield/import.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <array>
#include <utility>

#include "importers/formats.h"
#include "importers/import_options.h"
#include "importers/swc_reader.h"
#include "isofield/scene_file.h"

namespace isofield {

std::optional<ImportFormat> import_format(const std::string& path) {
  constexpr std::array<std::pair<const char*, ImportFormat>, 6> kExtensions = {{{".swc", ImportFormat::kSwc},
                                                                                {".eswc", ImportFormat::kSwc},
                                                                                {".pdb", ImportFormat::kPdb},
                                                                                {".ent", ImportFormat::kPdb},
                                                                                {".xyz", ImportFormat::kXyz},
                                                                                {".txt", ImportFormat::kPoints}}};
  for (const auto& [extension, format] : kExtensions) {
    if (absl::EndsWithIgnoreCase(path, extension)) return format;
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

absl::StatusOr<Imported> import_file(const std::string& path, const ImportOptions& options) {
  const auto format = import_format(path);
  if (!format) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": not a format that can be imported; expected .swc, .eswc, .pdb, .ent, .xyz or .txt"));
  }
  const auto text = read_file(path);
  if (!text.ok()) return text.status();
  const bool is_neuron = *format == ImportFormat::kPoints && looks_like_swc(*text);
  return import_text(*text, is_neuron ? ImportFormat::kSwc : *format, options, path);
}

}  // namespace isofield
