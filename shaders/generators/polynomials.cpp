// A build tool that writes the polynomials of server/operators/polynomial.h as GLSL (shaders/CMakeLists.txt).
#include <cstdio>

#include "operators/polynomial.h"

int main() {
  using namespace isofield::operators;
  std::printf(
      "// Written by shaders/generators/polynomials.cpp.\n#ifndef POLYNOMIALS_GLSL\n#define "
      "POLYNOMIALS_GLSL\n%s%s%s%s#endif\n",
      polynomial_glsl("phi_upper", phi_polynomial()).c_str(),
      polynomial_glsl("smooth_profile", smooth_profile_polynomial()).c_str(),
      value_glsl("logarithm", logarithm_polynomial()).c_str(),
      value_glsl("exponential", exponential_polynomial()).c_str());
}
