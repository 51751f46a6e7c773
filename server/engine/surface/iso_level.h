// The surface f = iso, whatever the field's law.
#pragma once

#include "operators/operator.h"

namespace isofield::engine {

struct IsoLevel {
  double iso = 0.5;
  operators::Law law = operators::Law::kPositive;

  // Above 0 inside.
  double excess(double f) const { return law == operators::Law::kSigned ? iso - f : f - iso; }
  // From the field's gradient towards the inside: 1 or -1.
  double inward() const { return law == operators::Law::kSigned ? -1 : 1; }
};

}  // namespace isofield::engine
