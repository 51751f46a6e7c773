// IsoLevel describes the surface f = iso in the same way for positive and for signed fields.
#pragma once

#include "operators/operator.h"

namespace isofield::engine {

struct IsoLevel {
  double iso = 0.5;
  operators::Law law = operators::Law::kPositive;

  // Returns how far the field value lies beyond iso: more than 0 inside, less outside.
  double excess(double f) const { return law == operators::Law::kSigned ? iso - f : f - iso; }
  // Returns the factor that makes the field's gradient point inwards: 1 or -1.
  double inward() const { return law == operators::Law::kSigned ? -1 : 1; }
};

}  // namespace isofield::engine
