// Parts of messages that several kinds of operators have in common. Refusals go to the reader that is given.
#pragma once

#include "base/field_reader.h"
#include "operators/kind.h"
#include "operators/opening.h"

namespace isofield::v1 {
class Opening;
}

namespace isofield::operators {

// `form`: a v1::Form.
Form read_form(int form, base::FieldReader& in);

// Returns radians of a stated angle within [0, 45] degrees.
double read_tangent_angle(absl::string_view field, double degrees, base::FieldReader& in);

// Returns radians, of the field `opening`.
Opening read_opening(const v1::Opening& message, base::FieldReader& in);

// The samples of a curve within [least, most], times `unit`.
std::vector<double> read_samples(absl::string_view field, const base::FieldReader::Numbers& numbers, double least,
                                 double most, double unit, absl::string_view expected, base::FieldReader& in);

// "field[i]".
std::string element_name(absl::string_view field, int i);

}  // namespace isofield::operators
