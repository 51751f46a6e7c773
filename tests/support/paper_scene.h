// Builds scenes in the terms of [G]: raw soft objects with the field w(distance / R), w(r) = (1 - r^2)^3, and the
// operators that the paper's claims are about.
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

// These functions return nodes in the scene's JSON.
std::string soft_sphere(const std::string& name, const blobtree::dvec3& centre, double R);
std::string soft_segment(const std::string& name, const blobtree::dvec3& a, const blobtree::dvec3& b, double R);
// The torus lies around the z axis and is centred at the origin.
std::string soft_torus(const std::string& name, double major_radius, double R);

// kContact uses the bulge silhouette with K = 0.8.
enum class Join { kSum, kMax, kCamel, kOrganic, kContact };
const char* text(Join join);
// Returns a node that joins `children`.
std::string join_node(Join join, const std::vector<std::string>& children, const std::string& name = "");

// Returns the distance at which a ray that starts inside of {f > iso} leaves it: its first crossing. The search takes
// `steps` steps up to `reach` and then bisects to the last bits. Returns nothing if the origin is not inside, or if
// there is no crossing.
using Field = std::function<double(const blobtree::dvec3&)>;
std::optional<double> exit_distance(const Field& f, const blobtree::dvec3& origin, const blobtree::dvec3& direction,
                                    double reach, int steps = 400, double iso = 0.5);

// Reports a measured figure of the running test: as a line on stdout, and as a property in the test's report.
void figure(const std::string& what, double value, const std::string& unit = "");

}  // namespace isofield::test_support
