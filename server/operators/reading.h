// These functions read parts of messages that several kinds of operators have in common. They report refusals to `in`.
#pragma once

#include "base/field_reader.h"
#include "operators/kind.h"
#include "operators/opening.h"

namespace isofield::v1 {
class Opening;
}

namespace isofield::operators {

// Reads a form; `form` is a v1::Form.
Form read_form(int form, base::FieldReader& in);

// Reads an angle in degrees within [0, 45] and returns it in radians.
double read_tangent_angle(absl::string_view field, double degrees, base::FieldReader& in);

// Reads the field `opening` of a message and returns it with angles in radians.
Opening read_opening(const v1::Opening& message, base::FieldReader& in);

// Reads the samples of a curve within [least, most] and returns them times `unit`.
std::vector<double> read_samples(absl::string_view field, const base::FieldReader::Numbers& numbers, double least,
                                 double most, double unit, absl::string_view expected, base::FieldReader& in);

// Returns the text "field[i]", which names an element in errors.
std::string element_name(absl::string_view field, int i);

}  // namespace isofield::operators
