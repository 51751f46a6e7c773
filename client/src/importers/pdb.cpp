#include <absl/strings/str_cat.h>

#include <exception>
#include <gemmi/pdb.hpp>

#include "importers/formats.h"
#include "importers/molecule.h"
#include "importers/pdb_lines.h"

namespace isofield {
namespace {

RigidMotion rigid_motion(const gemmi::Transform& transform) {
  RigidMotion motion;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) motion.rotation[j][i] = transform.mat[i][j];
    motion.shift[i] = transform.vec.at(i);
  }
  return motion;
}

Assembly to_assembly(const gemmi::Assembly& read) {
  Assembly assembly;
  assembly.name = read.name;
  for (const gemmi::Assembly::Gen& generator : read.generators) {
    Assembly::Part& part = assembly.parts.emplace_back();
    part.chains = generator.chains;
    for (const gemmi::Assembly::Operator& op : generator.operators) part.motions.push_back(rigid_motion(op.transform));
  }
  return assembly;
}

Molecule to_molecule(const gemmi::Structure& structure, const PdbLines& lines) {
  Molecule molecule;
  for (const gemmi::Assembly& assembly : structure.assemblies) molecule.assemblies.push_back(to_assembly(assembly));
  // gemmi sorts atoms by chains and residues; the lines keep their order.
  molecule.atoms.resize(lines.atoms.size());
  for (const gemmi::Chain& chain : structure.models.at(0).chains) {
    for (const gemmi::Residue& residue : chain.residues) {
      for (const gemmi::Atom& read : residue.atoms) {
        const auto index = static_cast<std::size_t>(read.serial);
        const PdbAtomLine& line = lines.atoms.at(index);
        molecule.atoms[index] = {.element = line.element,
                                 .center = {read.pos.x, read.pos.y, read.pos.z},
                                 .chain = line.chain,
                                 .assembly_chain = line.chain,
                                 .residue = line.residue,
                                 .number = line.number,
                                 .name = line.name,
                                 .altloc = line.altloc,
                                 .occupancy = read.occ,
                                 .source = line.source};
      }
    }
  }
  return molecule;
}

}  // namespace

absl::Status import_pdb(const std::string& text, const ImportOptions& options, Imported& imported) {
  imported.report.format = "molecule (PDB)";
  imported.scene.set_unit("angstrom");
  const auto lines = mend_pdb(text, options, imported.report);
  if (!lines.ok()) return lines.status();
  try {
    const gemmi::Structure structure = gemmi::read_pdb_string(lines->text, "");
    return add_molecule(to_molecule(structure, *lines), options, imported);
  } catch (const std::exception& error) {
    return absl::InvalidArgumentError(absl::StrCat("not a PDB file that can be read: ", error.what()));
  }
}

}  // namespace isofield
