#include "operators/joint.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "operators/reading.h"

namespace isofield::operators {
namespace {

using Numbers = base::FieldReader::Numbers;

// Returns number i of a list that has one number for each operand or one for all, or the default if the list is empty.
double listed(const Numbers& numbers, std::size_t i, double otherwise) {
  if (numbers.empty()) return otherwise;
  return numbers.size() == 1 ? numbers[0] : i < static_cast<std::size_t>(numbers.size()) ? numbers[i] : otherwise;
}

}  // namespace

OperandCount joint_operand_count(std::size_t terms, const BulgeElimination& by_angle) {
  if (by_angle.is_on) return {2, 2};
  if (terms > 1) return {terms, terms};
  return {2, kMaxOperands};
}

std::vector<Term> read_terms(const Numbers& ranges, const Numbers& powers, const Numbers& weights,
                             base::FieldReader& in) {
  const int count = std::max({ranges.size(), powers.size(), weights.size()});
  if (count > static_cast<int>(kMaxOperands)) {
    in.refuse("ranges", absl::StrCat("[", count, " numbers]"), absl::StrCat("at most ", kMaxOperands));
    return {};
  }
  if (ranges.empty()) in.miss("ranges", "one range, or one for each child");
  const struct {
    const char* name;
    const Numbers& numbers;
  } lists[] = {{"ranges", ranges}, {"powers", powers}, {"weights", weights}};
  for (const auto& [name, numbers] : lists) {
    if (numbers.size() > 1 && numbers.size() != count) {
      in.refuse(name, absl::StrCat("[", numbers.size(), " numbers]"), absl::StrCat("1 or ", count, " of them"));
    }
  }
  std::vector<Term> terms;
  for (int i = 0; i < count; ++i) {
    const Term t{listed(ranges, i, 1), listed(powers, i, 2), listed(weights, i, 1)};
    in.positive("ranges", t.range, absl::StrCat("[", i, "]"));
    in.number(element_name("powers", i), t.power, 1.0001, 64, "an exponent within ]1, 64]");
    in.number(element_name("weights", i), t.weight, 1e-3, 1e3, "a weight within [0.001, 1000]");
    terms.push_back(t);
  }
  return terms;
}

}  // namespace isofield::operators
