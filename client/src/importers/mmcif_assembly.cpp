#include "importers/mmcif_assembly.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>

#include <gemmi/numb.hpp>
#include <optional>

namespace isofield {
namespace {

constexpr std::size_t kMostOperators = 100'000;

using Motions = absl::flat_hash_map<std::string, RigidMotion>;

// Expands a list without brackets, such as "a,b" or "1-60". Returns false where a range descends or there are too many
// names.
bool expand_list(absl::string_view list, std::vector<std::string>& names) {
  for (const absl::string_view item : absl::StrSplit(list, ',')) {
    if (names.size() > kMostOperators) return false;
    const std::pair<absl::string_view, absl::string_view> ends = absl::StrSplit(item, absl::MaxSplits('-', 1));
    long long first = 0, last = 0;
    if (ends.second.empty() || !absl::SimpleAtoi(ends.first, &first) || !absl::SimpleAtoi(ends.second, &last)) {
      names.emplace_back(absl::StripAsciiWhitespace(item));
      continue;
    }
    if (last < first || last - first >= static_cast<long long>(kMostOperators)) return false;
    for (long long name = first; name <= last; ++name) names.push_back(absl::StrCat(name));
  }
  return names.size() <= kMostOperators;
}

RigidMotion product(const RigidMotion& a, const RigidMotion& b) {
  return {a.rotation * b.rotation, a(b.shift)};
}

Motions read_motions(gemmi::cif::Block& block) {
  std::vector<std::string> tags = {"id"};
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 3; ++j) tags.push_back(absl::StrCat("matrix[", i, "][", j, "]"));
    tags.push_back(absl::StrCat("vector[", i, "]"));
  }
  Motions motions;
  for (const auto row : block.find("_pdbx_struct_oper_list.", tags)) {
    RigidMotion motion;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) motion.rotation[j][i] = gemmi::cif::as_number(row[1 + 4 * i + j]);
      motion.shift[i] = gemmi::cif::as_number(row[4 + 4 * i]);
    }
    motions.emplace(row.str(0), motion);
  }
  return motions;
}

std::optional<RigidMotion> motion_of(const std::vector<std::string>& factors, const Motions& motions) {
  std::optional<RigidMotion> result;
  for (const std::string& name : factors) {
    const auto factor = motions.find(name);
    if (factor == motions.end()) return std::nullopt;
    result = result ? product(*result, factor->second) : factor->second;
  }
  return result;
}

}  // namespace

absl::StatusOr<std::vector<std::vector<std::string>>> expand_operators(absl::string_view expression) {
  std::vector<std::vector<std::string>> products = {{}};
  absl::string_view rest = absl::StripAsciiWhitespace(expression);
  while (!rest.empty()) {
    absl::string_view list = rest;
    if (rest[0] == '(') {
      const std::size_t end = rest.find(')');
      if (end == rest.npos) return absl::InvalidArgumentError(absl::StrCat(expression, ": a bracket is not closed"));
      list = rest.substr(1, end - 1);
      rest = absl::StripAsciiWhitespace(rest.substr(end + 1));
    } else {
      rest = {};
    }
    std::vector<std::string> names;
    if (!expand_list(list, names) || names.size() * products.size() > kMostOperators) {
      return absl::InvalidArgumentError(
          absl::StrCat(expression, ": expected ascending ranges, and ", kMostOperators, " operators at most"));
    }
    std::vector<std::vector<std::string>> longer;
    for (const auto& factors : products) {
      for (const std::string& name : names) longer.push_back(factors), longer.back().push_back(name);
    }
    products = std::move(longer);
  }
  return products;
}

std::vector<Assembly> read_assemblies(gemmi::cif::Block& block) {
  const Motions motions = read_motions(block);
  std::vector<Assembly> assemblies;
  absl::flat_hash_map<std::string, std::size_t> index;
  for (const auto row : block.find("_pdbx_struct_assembly_gen.", {"assembly_id", "oper_expression", "asym_id_list"})) {
    const std::string name = row.str(0);
    const auto [known, is_new] = index.try_emplace(name, assemblies.size());
    if (is_new) assemblies.emplace_back().name = name;
    Assembly::Part& part = assemblies[known->second].parts.emplace_back();
    for (const absl::string_view chain : absl::StrSplit(row.str(2), ',')) {
      part.chains.emplace_back(absl::StripAsciiWhitespace(chain));
    }
    const auto products = expand_operators(row.str(1));
    // An operator that cannot be read becomes a motion that is no rotation, for which add_molecule() refuses the
    // assembly. Files whose other assemblies are asked for are read all the same.
    if (!products.ok()) part.motions.push_back(RigidMotion());
    if (!products.ok()) continue;
    for (const auto& factors : *products) part.motions.push_back(motion_of(factors, motions).value_or(RigidMotion()));
  }
  return assemblies;
}

}  // namespace isofield
