#include "commands/import_flags.h"

#include <CLI/CLI.hpp>

namespace isofield {

void ImportFlags::add_to(CLI::App& command) {
  constexpr char kGroup[] = "Import";
  command
      .add_option("--operator", op,
                  "How pieces of an imported file are joined: camel, organic, contact, sum, max, ricci")
      ->check(CLI::IsMember({"camel", "organic", "contact", "sum", "max", "ricci"}))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--range-factor", options.range_factor,
                  "Range of a piece, as a multiple of its radius (default: neurons 1, molecules 0.5)")
      ->check(CLI::PositiveNumber)
      ->group(kGroup);
  command.add_option("--range", options.range, "Range of every piece, in model units")
      ->check(CLI::PositiveNumber)
      ->group(kGroup);
  command
      .add_option("--radius", options.radius,
                  "SWC: radius of samples without one (default: the file's smallest). Bare points: R (default: 0.5)")
      ->check(CLI::PositiveNumber)
      ->group(kGroup);
  command.add_flag("--keep-water", options.keep_water, "PDB: keep water molecules")->group(kGroup);
  command
      .add_option("--unit", options.unit,
                  "Unit of length of the file, to note in the scene, such as \"nm\" or \"8 nm\" (default: neurons um, "
                  "molecules angstrom)")
      ->group(kGroup);
}

ImportOptions ImportFlags::get() const {
  ImportOptions result = options;
  result.op = *import_operator(op);
  return result;
}

}  // namespace isofield
