#include "importers/cif_document.h"

#include <absl/strings/str_cat.h>

#include <exception>
#include <gemmi/cif.hpp>
#include <gemmi/json.hpp>

// gemmi's two readers take seconds to compile, so only this file includes them.

namespace isofield {
namespace {

template <typename Read>
absl::StatusOr<gemmi::cif::Document> guarded(absl::string_view format, const Read& read) {
  try {
    return read();
  } catch (const tao::pegtl::parse_error& error) {
    return absl::InvalidArgumentError(
        absl::StrCat("line ", error.positions().front().line, ": not ", format, ": ", std::string(error.message())));
  } catch (const std::exception& error) {
    return absl::InvalidArgumentError(absl::StrCat("not ", format, ": ", error.what()));
  }
}

}  // namespace

absl::StatusOr<gemmi::cif::Document> read_cif(const std::string& text) {
  return guarded("CIF", [&] { return gemmi::cif::read_memory(text.data(), text.size(), "text"); });
}

absl::StatusOr<gemmi::cif::Document> read_mmjson(std::string text) {
  return guarded("mmJSON", [&] { return gemmi::cif::read_mmjson_insitu(text.data(), text.size(), "text"); });
}

}  // namespace isofield
