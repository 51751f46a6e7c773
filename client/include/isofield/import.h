#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield {

// Scenes from the files of other fields: neurons (SWC), molecules (PDB, mmCIF, XYZ) and bare points.
//
// Damage does not stop an import. What cannot be used is dropped or mended, and the report says what, where and why.

enum class ImportFormat { kSwc, kPdb, kMmcif, kXyz, kPoints };

// How the pieces are joined; all by one n-ary operator node, named "model", over the pieces in the file's order.
enum class ImportOperator {
  // Gradient blends ([G] Table I). Camel blends branches at right angles and leaves aligned joints without a bulge.
  kCamel,
  kOrganic,
  // With a BULGE silhouette of strength 0.8.
  kContact,
  kSum,
  kMax,
  // Exponent 4.
  kRicci,
};

struct ImportOptions {
  ImportOperator op = ImportOperator::kCamel;
  // Range of each piece: range_factor * its radius (the larger one of a segment), or `range` where it is stated.
  // Both > 0. Without either: neurons 1 * radius; molecules 0.5 * radius, which leaves the atoms visible. Bare points
  // have the range that belongs to their R unless `range` is stated.
  std::optional<double> range_factor;
  std::optional<double> range;
  // Bare points: R of the soft objects, > 0; 0.5 without it.
  std::optional<double> radius;
  // Bare points: the column that holds each point's own R, by its name in the header or its number from 1.
  std::string radius_column;
  // SWC: the least radius of a sample, > 0. A sample that is thinner, or has no usable radius, gets this one; without
  // it, the latter gets its parent's.
  std::optional<double> min_radius;
  // SWC: multiply lengths by the file's "# SCALE x y z": coordinates by axis, radii by the geometric mean.
  bool apply_scale = false;
  // Molecules: which frame of an XYZ file, or which model of a PDB or mmCIF file, is taken; from 1, by its place.
  std::optional<int> frame;
  // PDB and mmCIF: only these chains, also of an assembly; empty: all.
  std::vector<std::string> chains;
  // PDB and mmCIF: the alternate location that is taken, such as "A". Empty, and in residues that lack it: the one of
  // the highest occupancy, the mean over the residue's atoms; of equal ones the first. Atoms without one always stay.
  std::string altloc;
  // PDB and mmCIF: the biological assembly that is made, by its name in the file. Empty: the atoms as they stand.
  std::string assembly;
  // Molecules: hydrogen and its isotopes. PDB and mmCIF: water.
  bool keep_hydrogens = true;
  bool keep_waters = false;
  // Scene::unit. Empty: "angstrom" for molecules, "um" for neurons, since SWC does not state one and micrometres are
  // the rule of its largest archive, none for bare points. Files in voxels need theirs: "8 nm".
  std::string unit;
};

// What became of a file.
struct ImportReport {
  // One kind of thing that happened to lines of the file.
  struct Finding {
    // Such as "sample dropped: a coordinate is not a finite number".
    std::string what;
    std::size_t count = 0;
    // The first few: "line 17: ..." .
    std::vector<std::string> examples;
    // False for remarks on sound input, such as left out water.
    bool damage = true;
  };
  // Such as "neuron (SWC)".
  std::string format;
  // Samples, atoms or points that the file has, and pieces (primitives) that were made of them.
  std::size_t read = 0;
  std::size_t pieces = 0;
  std::vector<Finding> findings;

  bool damaged() const;
  // Lines for a person; the first is a summary.
  std::string text() const;
};

struct Imported {
  v1::Scene scene;
  ImportReport report;
};

// What the ending of a file's name promises: .swc, .eswc; .pdb, .ent; .cif, .mmcif; .xyz; .txt (points); each also with
// .gz after it. Nothing: another ending.
std::optional<ImportFormat> import_format(const std::string& path);

// "camel", "organic", "contact", "sum", "max" or "ricci".
std::optional<ImportOperator> import_operator(const std::string& name);

// SWC: an edge is a segment (round cone) from a sample to its parent with both radii; a tree without an edge is a
// sphere.
//  - Columns "id type x y z radius parent", between blanks, tabs, commas or semicolons; further columns and comments
//    (#) are ignored. Ids are whole numbers of 64 bits. A negative parent, or the sample itself, makes a root. Types
//    are kept as they are; 1 is a soma.
//  - A soma is all samples of type 1 that are linked. One sample, or three as NeuroMorpho writes them (the second and
//    third opposite each other at the radius of the first, their parent), is a sphere; two are a capsule; others have a
//    segment for each edge. Thin samples on a closed loop or the ends of a star, in one plane, are a contour: an
//    ellipsoid, whose third axis is the mean of the two. Contours at several depths, also of trees of their own, are
//    the hull of balls that touch them. An edge between a soma and another type begins at the soma's surface and has
//    the other's radius there; what lies within the soma is left out, unless it is thicker than the soma.
//  - "# SCALE x y z" is reported. With ImportOptions::apply_scale coordinates are multiplied by it, axis by axis, and
//    radii by the geometric mean of the three, so that three equal factors are a change of unit. (Cannon's cvapp, where
//    the header comes from, notes in it what coordinates were multiplied by already, and leaves radii alone.)
//  - Samples without a usable id, or with a coordinate that is not within 2.5e8, are dropped; their children, and those
//    of samples that do not exist, become roots. Of doubled ids the first is used. A cycle is cut at its first sample
//    in the file. A sample without a radius within [1e-9, 2.5e8] gets ImportOptions::min_radius, or its parent's; a
//    root gets that of its nearest descendant that has one. Edges of length 0 are dropped where another piece covers
//    them.
//  - The report has a remark where the largest radius is implausible in micrometres and no unit is stated.
//  - Pieces come parents first; a file that is in that order keeps it. Named "n<id>" after the sample at the far end;
//    an edge that leads to a soma from its parent, "n<id>/edge" where the soma has that name. A piece may be a
//    Transform of a node without a name.
//  - INVALID_ARGUMENT: also a root without a radius for it; the message names the line.
// PDB and mmCIF (mmJSON too): a sphere of van der Waals radius for each atom of one model, in angstrom. Named
// "CHAIN/RESIDUE/ATOM" where that is unique; in copies of a chain that an assembly makes, "CHAIN-2/RESIDUE/ATOM".
//  - Water, and all locations of a residue but one, are left out. Frames that END parts are models. Chains have the
//    names that their authors gave them (auth_asym_id).
//  - PDB: a line whose fields are not in their columns is mended where it is certain which field is which: after serial
//    numbers of six digits or more, with tabs, or with blanks between all fields. A line without three whole
//    coordinates is dropped. Where no element is stated, the atom's name, its residue and its columns tell it: amino
//    acids and nucleotides hold C, N, O, S, P, H and Se only, so that "CA" there is a carbon, also left-justified.
//  - mmCIF: of the columns of _atom_site only Cartn_x, Cartn_y and Cartn_z must be there. A line of an atom with too few
//    or too many values is dropped; other damage ends the import with the line's number.
// XYZ: frames of "count, comment, lines of: element x y z" as molecules, in angstrom, or in bohr where the count line
// says so. Lines "x y z" alone, also after a count, are points.
//  - "Properties=" in the comment decides the columns. An element is a symbol, a label ("C12", "Fe3+"), an isotope
//    ("13C", "D") or an atomic number; a label in capitals such as "CA1" is the lighter element, here carbon.
//  - Files of Tinker, whose atoms are numbered, are recognised.
// Points: lines "x y z" as soft objects w(distance / R), that is radius r0 R and range (1 - r0) R.
//  - With a header the columns x, y and z, in any order, and as R the column "radius" (or "r", where there is no "g"
//    beside it). Case, quotes and a unit, as in "X (um)", do not matter; "position x", "pos_x" and the like serve where
//    x, y, z are not there. INVALID_ARGUMENT: the header names no x, y, z, or one of them twice.
//  - Without a header the first three columns; the report mentions others. ImportOptions::radius_column is R's.
//  - Cells are parted by commas, semicolons, tabs or blanks. Decimal commas are read between semicolons.
//
// INVALID_ARGUMENT: an option out of its range; a model, frame, chain, alternate location or assembly that is not in
// the file, with those that are; or nothing in the text that could be used. `name` stands for the file.
absl::StatusOr<Imported> import_text(const std::string& text, ImportFormat format, const ImportOptions& options,
                                     const std::string& name);

// The same of a file, which may be packed by gzip. Its format is told by its content where that is plain (molecules,
// neurons), else by the ending of its name, else by the content again: lines of three numbers are points.
// INVALID_ARGUMENT, too: nothing that can be imported; the message says what it is, where that is known, and what can
// be read. Others: those of read_file (scene_file.h).
absl::StatusOr<Imported> import_file(const std::string& path, const ImportOptions& options);

// A scene from a file, and what its import had to report where it was imported.
struct LoadedScene {
  v1::Scene scene;
  std::optional<ImportReport> report;
};

// A file that is a scene (proto3 JSON or the binary message) as it is, any other as import_file() does; its content
// tells.
absl::StatusOr<LoadedScene> load_scene_file(const std::string& path, const ImportOptions& options);

}  // namespace isofield
