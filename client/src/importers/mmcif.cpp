#include "importers/formats.h"

namespace isofield {

absl::Status import_mmcif(const std::string&, const ImportOptions&, Imported&) {
  return absl::UnimplementedError("mmCIF is not read yet");
}

}  // namespace isofield
