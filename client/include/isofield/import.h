#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <string>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield {

// Scenes from the files of other fields: neurons (SWC), molecules (PDB, mmCIF, XYZ) and bare points.
//
// Damage does not stop an import. Lines that cannot be used are dropped or mended, and the report says which and why.

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
  // SWC: the least radius of a sample, > 0. A sample that is thinner or has no usable radius gets this one. Without
  // this option a sample that has no usable radius gets its parent's.
  std::optional<double> min_radius;
  // SWC: true multiplies lengths by the file's "# SCALE x y z": coordinates by axis, radii by the geometric mean.
  bool apply_scale = false;
  // Molecules: the frame of an XYZ file, or the model of a PDB or mmCIF file, that is imported, counted from 1. The
  // first one without it.
  std::optional<int> frame;
  // PDB and mmCIF: only these chains are imported, also of an assembly. Empty: all chains.
  std::vector<std::string> chains;
  // PDB and mmCIF: the alternate location that is imported, such as "A". Without it, and in residues that lack it, it
  // is the one whose atoms have the highest mean occupancy in the residue, the first one of equals. Atoms that have no
  // alternate location are always kept.
  std::string altloc;
  // PDB and mmCIF: the biological assembly that is made, by its name in the file. Empty: the atoms as they stand.
  std::string assembly;
  // Molecules: whether hydrogen and its isotopes are imported. PDB and mmCIF: whether water is.
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

// The format that the ending of a file's name promises: .swc, .eswc; .pdb, .ent; .cif, .mmcif; .xyz; .txt (points).
// Each may have .gz after it. Nothing: it is another ending.
std::optional<ImportFormat> import_format(const std::string& path);

// "camel", "organic", "contact", "sum", "max" or "ricci".
std::optional<ImportOperator> import_operator(const std::string& name);

// SWC: an edge is a segment (round cone) from a sample to its parent with both radii; a tree without an edge is a
// sphere.
//  - The columns are "id type x y z radius parent", separated by blanks, tabs, commas or semicolons. Further columns
//    and comments (#) are ignored. Ids are whole numbers of 64 bits. A negative parent, or the sample itself, makes a
//    root. Types are kept as they are; 1 is a soma.
//  - Linked samples of type 1 are a soma. A soma of one sample is a sphere, and so is one of three as NeuroMorpho
//    writes it (the second and the third are opposite each other at the radius of the first, their parent). Two samples
//    are a capsule; others have a segment for each edge. Thin samples in one plane, on a closed loop or at the ends of
//    a star, are a contour, which becomes an ellipsoid whose third axis is the mean of the two others. Contours at
//    several depths, also in trees of their own, become the hull of balls that touch them. An edge between a soma and a
//    sample of another type begins at the soma's surface with that sample's radius. Edges within the soma are left out,
//    unless they are thicker than it.
//  - A header "# SCALE x y z" is reported. With ImportOptions::apply_scale coordinates are multiplied by it, axis by
//    axis, and radii by the geometric mean of the three, so that three equal factors are a change of unit. It is not
//    applied unasked, since some programs note in it what they have multiplied the coordinates by already.
//  - Samples without a usable id, or with a coordinate that is not within 2.5e8, are dropped; their children, and those
//    of samples that do not exist, become roots. Of doubled ids the first is used. A cycle is cut at its first sample
//    in the file. A sample without a radius within [1e-9, 2.5e8] gets ImportOptions::min_radius, or its parent's; a
//    root gets that of its nearest descendant that has one. Edges of length 0 are dropped where another piece covers
//    them.
//  - The report has a remark where the largest radius is implausible in micrometres and no unit is stated.
//  - Pieces come parents first; a file that is in that order keeps it. A piece is named "n<id>" after the sample at its
//    far end. An edge from a parent to a soma is named "n<id>/edge" where the soma itself has that name. A piece may be
//    a Transform of a node without a name.
//  - INVALID_ARGUMENT, too: there is no radius for a root; the message names the line.
//
// PDB and mmCIF (also as mmJSON): each atom of one model is a sphere of its van der Waals radius, in angstrom. It is
// named "CHAIN/RESIDUE/ATOM" where that is unique, and "CHAIN-2/RESIDUE/ATOM" in the second copy of a chain in an
// assembly.
//  - Water, and all locations of a residue but one, are left out. Frames between records END count as models. Chains
//    have the names that their authors gave them (auth_asym_id).
//  - PDB: a line whose fields are not in their columns is mended where it is certain which field is which. Causes are
//    serial numbers of six digits or more, tabs, and fields that are only separated by blanks. A line without three
//    whole coordinates is dropped. Where no element is stated, the atom's name, its residue and its columns tell it:
//    amino acids and nucleotides hold C, N, O, S, P, H and Se only, so that "CA" there is a carbon even if it is
//    left-justified.
//  - mmCIF: of the columns of _atom_site, only Cartn_x, Cartn_y and Cartn_z must be there. An atom's line with too few
//    or too many values is dropped; other damage ends the import with the line's number.
//
// XYZ: frames of "count, comment, lines of: element x y z" as molecules, in angstrom, or in bohr where the count line
// says so. Lines "x y z" alone, also after a count, are points.
//  - "Properties=" in the comment states the columns. An element is a symbol, a label ("C12", "Fe3+"), an isotope
//    ("13C", "D") or an atomic number; a label in capitals such as "CA1" is the lighter element, here carbon.
//  - Files of Tinker, whose atoms are numbered, are recognised.
//
// Points: lines "x y z" as soft objects w(distance / R), that is radius r0 R and range (1 - r0) R.
//  - With a header the columns x, y and z are read, in any order, and as R the column "radius" (or "r", where there is
//    no "g" beside it). Case, quotes and a unit, as in "X (um)", do not matter; "position x", "pos_x" and the like
//    serve where x, y, z are not there. INVALID_ARGUMENT: the header names no x, y, z, or one of them twice.
//  - Without a header the first three columns are read, and the report mentions others. ImportOptions::radius_column
//    names the column of R.
//  - Cells are separated by commas, semicolons, tabs or blanks. Decimal commas are read between semicolons only.
//
// INVALID_ARGUMENT: an option out of its range; a model, frame, chain, alternate location or assembly that is not in
// the file, with those that are; or nothing in the text that could be used. `name` stands for the file.
absl::StatusOr<Imported> import_text(const std::string& text, ImportFormat format, const ImportOptions& options,
                                     const std::string& name);

// Imports a file, which may be packed by gzip. The content tells the format where it is unmistakable (molecules,
// neurons), else the ending of the name does. Where that says nothing either, lines of three numbers are points.
// INVALID_ARGUMENT, too: the file cannot be imported; the message says what it is, where that is known, and what can be
// read. Other errors are those of read_file() (scene_file.h).
absl::StatusOr<Imported> import_file(const std::string& path, const ImportOptions& options);

// A scene from a file, with the report of its import if the file was no scene itself.
struct LoadedScene {
  v1::Scene scene;
  std::optional<ImportReport> report;
};

// Reads a file that is a scene (proto3 JSON or the binary message), and imports any other as import_file() does. The
// content tells which it is.
absl::StatusOr<LoadedScene> load_scene_file(const std::string& path, const ImportOptions& options);

}  // namespace isofield
