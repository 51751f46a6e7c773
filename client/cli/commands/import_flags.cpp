#include "commands/import_flags.h"

#include "commands/checks.h"

namespace isofield {

void ImportFlags::add_to(Command command) {
  constexpr char kGroup[] = "Import";
  command
      .add_option("--operator", op,
                  "How pieces of an imported file are joined: camel, organic, contact, sum, max, ricci")
      .one_of({"camel", "organic", "contact", "sum", "max", "ricci"})
      .shows_default()
      .group(kGroup);
  command
      .add_option("--range-factor", options.range_factor,
                  "Range of a piece, as a multiple of its radius (default: neurons 1, molecules 0.5)")
      .check(positive())
      .group(kGroup);
  command.add_option("--range", options.range, "Range of every piece, in model units").check(positive()).group(kGroup);
  command
      .add_option("--radius", options.radius,
                  "Bare points: R, the distance from a point at which its field ends (default: 0.5)")
      .check(positive())
      .group(kGroup);
  command
      .add_option("--radius-column", options.radius_column,
                  "Bare points: the column that holds each point's own R, by its name in the header or its number from "
                  "1")
      .group(kGroup);
  command
      .add_option("--min-radius", options.min_radius,
                  "SWC: least radius of a sample (default: samples without a radius have their parent's)")
      .check(positive())
      .group(kGroup);
  command.add_flag("--apply-scale", options.apply_scale, "SWC: multiply lengths by the file's \"# SCALE x y z\"")
      .group(kGroup);
  command
      .add_option("--model,--frame", options.frame,
                  "Molecules: which model (PDB, mmCIF) or frame (XYZ) is taken, from 1 (default: the first)")
      .check(whole(1, 1u << 31))
      .group(kGroup);
  command.add_option("--chain", options.chains, "PDB, mmCIF: only these chains, such as A,B")
      .delimiter(',')
      .group(kGroup);
  command
      .add_option("--altloc", options.altloc,
                  "PDB, mmCIF: the alternate location to take (default: in each residue the one of highest occupancy)")
      .group(kGroup);
  command
      .add_option("--assembly", options.assembly,
                  "PDB, mmCIF: the biological assembly to make, such as 1 (default: the atoms as they stand)")
      .group(kGroup);
  command.add_flag("--hydrogens,!--no-hydrogens", options.keep_hydrogens, "Molecules: keep hydrogen (default), or not")
      .group(kGroup);
  command.add_flag("--waters", options.keep_waters, "PDB, mmCIF: keep water molecules").group(kGroup);
  command
      .add_option("--unit", options.unit,
                  "Unit of length of the file, to note in the scene, such as \"nm\" or \"8 nm\" (default: neurons um, "
                  "molecules angstrom)")
      .group(kGroup);
}

ImportOptions ImportFlags::get() const {
  ImportOptions result = options;
  result.op = *import_operator(op);
  return result;
}

}  // namespace isofield
