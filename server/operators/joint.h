// This file has what the operators that take all their operands at once share: their result, the mask of their
// operands, and the reading of their terms.
#pragma once

#include <cstdint>
#include <vector>

#include "base/field_reader.h"
#include "operators/bulge_elimination.h"
#include "operators/kind.h"
#include "operators/terms.h"

namespace isofield::operators {

// Joint is the value of an operator with its partial derivatives by each operand.
template <class T>
struct Joint {
  T g;
  std::vector<T> partials;
};

// OperandMask has a bit for each operand that pruning has left, of the `operands` that the operator had.
struct OperandMask {
  std::uint32_t bits, operands;
  bool has(std::uint32_t operand) const { return (bits >> operand & 1) != 0; }
};

// Returns how many operands an operator takes: as many as it has terms, any number if there is one term for all, or two
// if ranges follow an angle.
OperandCount joint_operand_count(std::size_t terms, const BulgeElimination& by_angle);

// Reads one term for each operand, or one for all. A list holds one number for each operand, one for all, or none if it
// has a default; ranges have no default.
std::vector<Term> read_terms(const base::FieldReader::Numbers& ranges, const base::FieldReader::Numbers& powers,
                             const base::FieldReader::Numbers& weights, base::FieldReader& in);

}  // namespace isofield::operators
