// Makes scenes from the files of other fields: neurons (SWC), molecules (PDB, mmCIF, XYZ) and bare points.
//
// Damage does not stop an import. Lines that cannot be used are dropped or mended, and the report says which lines and
// why.
#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield {

enum class ImportFormat { kSwc, kPdb, kMmcif, kXyz, kPoints };

// The operator that joins the pieces. It is one n-ary operator node, named "model", over the pieces in the order of the
// file.
enum class ImportOperator {
  // The first three are gradient blends (Gourmel et al. 2013, [G], Table I). Camel blends branches at right angles and
  // leaves aligned joints without a bulge.
  kCamel,
  kOrganic,
  // This one also has a BULGE silhouette of strength 0.8.
  kContact,
  kSum,
  kMax,
  // The exponent is 4.
  kRicci,
};

// The choices of an import. An option whose comment begins with formats counts for these formats only.
struct ImportOptions {
  ImportOperator op = ImportOperator::kCamel;
  // The range of each piece is range_factor * its radius (the larger one of a segment), or `range` where it is stated.
  // Both are > 0. Without either, the range is 1 * radius for neurons, and 0.5 * radius for molecules, which leaves the
  // atoms visible. Bare points have the range that belongs to their R unless `range` is stated.
  std::optional<double> range_factor;
  std::optional<double> range;
  // Bare points: the R of the soft objects, > 0. Without it R is 0.5.
  std::optional<double> radius;
  // Bare points: the column that holds the R of each point, by its name in the header or its number from 1.
  std::string radius_column;
  // SWC: the least radius of a sample, > 0. A sample that is thinner or has no usable radius gets this one. Without
  // this option a sample that has no usable radius gets the radius of its parent.
  std::optional<double> min_radius;
  // SWC: if true, lengths are multiplied by the "# SCALE x y z" of the file: each coordinate by the factor of its axis,
  // radii by the geometric mean of the three factors.
  bool apply_scale = false;
  // Molecules: the frame of an XYZ file, or the model of a PDB or mmCIF file, that is imported, counted from 1. Without
  // it the first one is imported.
  std::optional<int> frame;
  // PDB and mmCIF: only these chains are imported, also of an assembly. If the list is empty, all chains are.
  std::vector<std::string> chains;
  // PDB and mmCIF: the alternate location that is imported, such as "A". Without it, and in residues that lack it, the
  // location whose atoms have the highest mean occupancy in the residue is imported; the first one counts where several
  // are equal. Atoms that have no alternate location are always kept.
  std::string altloc;
  // PDB and mmCIF: the biological assembly that is made, by its name in the file. If it is empty, the atoms are
  // imported as they stand in the file.
  std::string assembly;
  // Molecules: whether hydrogen and its isotopes are imported. PDB and mmCIF: whether water is.
  bool keep_hydrogens = true;
  bool keep_waters = false;
  // The unit of the scene (Scene.unit). If it is empty, the unit is "angstrom" for molecules and "um" for neurons,
  // since SWC does not state one and its largest archive uses micrometres; bare points then have no unit. A file in
  // voxels needs the size of a voxel: "8 nm".
  std::string unit;
};

// A report of how a file was read: how much of it, and what was dropped, mended or left out.
struct ImportReport {
  // One kind of thing that happened to lines of the file.
  struct Finding {
    // The event, such as "sample dropped: a coordinate is not a finite number".
    std::string what;
    std::size_t count = 0;
    // The first few of these lines, such as "line 17: ...".
    std::vector<std::string> examples;
    // False for a remark on sound input, such as water that was left out.
    bool damage = true;
  };
  // The format, such as "neuron (SWC)".
  std::string format;
  // The number of samples, atoms or points in the file, and of pieces (primitives) that were made of them.
  std::size_t read = 0;
  std::size_t pieces = 0;
  std::vector<Finding> findings;

  // Returns true where a finding is damage.
  bool damaged() const;
  // Returns the report as lines for a person; the first line is a summary.
  std::string text() const;
};

// The result of an import.
struct Imported {
  v1::Scene scene;
  ImportReport report;
};

// Returns the format that the ending of a file name promises: .swc, .eswc; .pdb, .ent; .cif, .mmcif; .xyz; .txt
// (points). Each may have .gz after it. Returns nothing for any other ending.
std::optional<ImportFormat> import_format(const std::string& path);

// Returns the operator of a name: "camel", "organic", "contact", "sum", "max" or "ricci". Returns nothing for any other
// name.
std::optional<ImportOperator> import_operator(const std::string& name);

// Imports a text; `name` stands for the file in errors. The formats are read as follows.
//
// SWC: an edge is a segment (round cone) from a sample to its parent with both radii. A tree without an edge is a
// sphere.
//  - The columns are "id type x y z radius parent", separated by blanks, tabs, commas or semicolons. Further columns
//    and comments (#) are ignored. Ids are whole numbers of 64 bits. A negative parent, or the sample itself as parent,
//    makes a root. Types are kept as they are; 1 is a soma.
//  - Linked samples of type 1 are a soma. A soma of one sample is a sphere. So is a soma of three samples as
//    NeuroMorpho writes it: the second and the third are opposite each other at the radius of the first, their parent.
//    Two samples are a capsule, and other somata have a segment for each edge. Thin samples in one plane, on a closed
//    loop or at the ends of a star, are a contour, which becomes an ellipsoid whose third axis is the mean of the two
//    others. Contours at several depths, also in trees of their own, become the hull of balls that touch them. An edge
//    between a soma and a sample of another type begins at the surface of the soma with the radius of that sample.
//    Edges within the soma are left out, unless they are thicker than the soma.
//  - A header "# SCALE x y z" is reported. With ImportOptions::apply_scale, coordinates are multiplied by it, axis by
//    axis, and radii by the geometric mean of the three factors, so that three equal factors are a change of unit. It
//    is not applied by default, since some programs write there the factors that they have already applied.
//  - A sample without a usable id, or with a coordinate that is not within 2.5e8, is dropped. Its children become
//    roots, and so do the children of samples that do not exist. Where two samples have the same id, the first one is
//    used. A cycle is cut at its first sample in the file. A sample without a radius within [1e-9, 2.5e8] gets
//    ImportOptions::min_radius, or the radius of its parent; a root gets that of its nearest descendant that has one.
//    An edge of length 0 is dropped where another piece covers it.
//  - The report has a remark where the largest radius is implausible in micrometres and no unit is stated.
//  - Pieces come with parents first; a file that is in that order keeps it. A piece is named "n<id>" after the sample
//    at its far end. An edge from a parent to a soma is named "n<id>/edge" where the soma itself has that name. A piece
//    may be a Transform of a node without a name.
//  - INVALID_ARGUMENT, too: there is no radius for a root; the message names the line.
//
// PDB and mmCIF (also as mmJSON): each atom of one model is a sphere of its van der Waals radius, in angstrom. It is
// named "CHAIN/RESIDUE/ATOM" where that is unique, and "CHAIN-2/RESIDUE/ATOM" in the second copy of a chain in an
// assembly.
//  - Water, and all locations of a residue but one, are left out. Frames that END records separate count as models.
//    Chains have the names that their authors gave them (auth_asym_id).
//  - PDB: a line whose fields are not in their columns is mended where it is certain which field is which. Causes are
//    serial numbers of six digits or more, tabs, and fields that only blanks separate. A line without three whole
//    coordinates is dropped. Where no element is stated, the name of the atom, its residue and its columns tell it.
//    Amino acids and nucleotides hold C, N, O, S, P, H and Se only, so that "CA" there is a carbon even if it is
//    left-justified.
//  - mmCIF: of the columns of _atom_site, only Cartn_x, Cartn_y and Cartn_z must be there. An atom whose line has too
//    few or too many values is dropped; other damage ends the import with the number of the line.
//
// XYZ: frames of "count, comment, lines of: element x y z" are molecules, in angstrom, or in bohr where the count line
// says so. Lines "x y z" alone, also after a count, are points.
//  - "Properties=" in the comment states the columns. An element is a symbol, a label ("C12", "Fe3+"), an isotope
//    ("13C", "D") or an atomic number. A label in capitals such as "CA1" means the lighter element, here carbon.
//  - Files of the program Tinker, whose atoms are numbered, are recognised.
//
// Points: lines "x y z" are soft objects w(distance / R). Each is a sphere of radius r0 R and range (1 - r0) R, where
// w(r0) is 1/2.
//  - With a header, the columns x, y and z are read, in any order. R is the column "radius", or "r" where there is no
//    column "g" beside it. Case, quotes and a unit, as in "X (um)", do not matter. Names such as "position x" and
//    "pos_x" serve where x, y and z are not there. INVALID_ARGUMENT: the header names no x, y, z, or one of them twice.
//  - Without a header, the first three columns are read, and the report mentions others. ImportOptions::radius_column
//    names the column of R.
//  - Cells are separated by commas, semicolons, tabs or blanks. Decimal commas are read between semicolons only.
//
// INVALID_ARGUMENT: an option is out of its range; a model, frame, chain, alternate location or assembly is not in the
// file (the message lists those that are); or nothing in the text could be used.
absl::StatusOr<Imported> import_text(const std::string& text, ImportFormat format, const ImportOptions& options,
                                     const std::string& name);

// Imports a file, which may be packed by gzip. The content tells the format where it is unmistakable (molecules,
// neurons); else the ending of the name does. Where the ending tells nothing either, lines of three numbers are points.
// INVALID_ARGUMENT, too: the file cannot be imported; the message says what the file is, where that is known, and which
// files can be read. Other errors are those of read_file() (scene_file.h).
absl::StatusOr<Imported> import_file(const std::string& path, const ImportOptions& options);

// A scene from a file, with the report of its import if the file was not a scene already.
struct LoadedScene {
  v1::Scene scene;
  std::optional<ImportReport> report;
};

// Reads a file that is a scene (proto3 JSON or the binary message), and imports any other file as import_file() does.
// The content tells which of the two it is.
absl::StatusOr<LoadedScene> load_scene_file(const std::string& path, const ImportOptions& options);

}  // namespace isofield
