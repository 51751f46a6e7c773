#include "importers/molecule.h"

#include "importers/import_options.h"
#include "importers/import_report.h"

namespace isofield {
namespace {

// Without ImportOptions::range_factor.
constexpr double kRangeFactor = 0.5;

}  // namespace

v1::Node& add_atom(const Element* element, const std::array<double, 3>& center, const AtomSource& source,
                   const ImportOptions& options, Imported& imported) {
  double radius = element ? element->radius : 0;
  if (radius == 0) {
    note(imported.report, "atom without a known van der Waals radius: 2.0 angstrom used", source.line_number,
         source.line);
    radius = kUnknownElementRadius;
  }
  v1::Node& node = *imported.scene.add_nodes();
  v1::Sphere& sphere = *node.mutable_sphere();
  for (const double coordinate : center) sphere.add_center(coordinate);
  sphere.set_radius(radius);
  sphere.set_range(range_of(options, kRangeFactor, radius));
  return node;
}

}  // namespace isofield
