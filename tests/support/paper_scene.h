// Scenes in the terms of [G]: raw soft objects w(distance / R) with the field w(r) = (1 - r^2)^3, and the operators
// that the paper's claims are about.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "blobtree/primitives/falloff.h"

namespace isofield::test_support {

// The surface of a raw soft object of radius R is at kSoftRadius R from its skeleton.
inline constexpr double kSoftRadius = blobtree::kR0;

// Nodes in the scene's JSON.
std::string soft_sphere(const std::string& name, const blobtree::dvec3& centre, double R);
std::string soft_segment(const std::string& name, const blobtree::dvec3& a, const blobtree::dvec3& b, double R);
// Around the z axis, centred at the origin.
std::string soft_torus(const std::string& name, double major_radius, double R);

// kContact: with the bulge of K = 0.8.
enum class Join { kSum, kMax, kCamel, kOrganic, kContact };
const char* text(Join join);
// A node that joins `children`.
std::string join_node(Join join, const std::vector<std::string>& children, const std::string& name = "");

// Where a ray from within leaves {f > iso}: its first crossing, sought in `steps` steps up to `reach`, to the last
// bits.
using Field = std::function<double(const blobtree::dvec3&)>;
std::optional<double> exit_distance(const Field& f, const blobtree::dvec3& origin, const blobtree::dvec3& direction,
                                    double reach, int steps = 400, double iso = 0.5);

// A measured figure of the running test: a line on stdout, and a property in its report.
void figure(const std::string& what, double value, const std::string& unit = "");

}  // namespace isofield::test_support
