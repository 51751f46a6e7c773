// Writes the profile polynomials as GLSL, at build time: shaders/CMakeLists.txt.
#include <cstdio>

#include "operators/polynomial.h"

int main() {
  using namespace isofield::operators;
  std::printf("// Written by server/operators/write_polynomials.cpp.\n%s%s",
              polynomial_glsl("phi_upper", phi_polynomial()).c_str(),
              polynomial_glsl("smooth_profile", smooth_profile_polynomial()).c_str());
}
