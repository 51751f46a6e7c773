#include "operators/bulge_elimination.h"

#include "base/field_reader.h"

namespace isofield::operators {

BulgeElimination read_bulge_elimination(bool is_on, double omega, base::FieldReader& in) {
  BulgeElimination e{.is_on = is_on};
  if (omega != 0) e.omega = in.number("omega", omega, 0.001, 1, "a number within [0.001, 1], or 0 for 0.01");
  return e;
}

}  // namespace isofield::operators
