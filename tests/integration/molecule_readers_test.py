"""Imports molecules with the command line and compares every atom, its place and the radius of its element, with what
gemmi (PDB, mmCIF) and ASE (XYZ) read from the same files. Files that no reader reads right are compared with
the whole file that they were made of. Prints a line for each comparison.

Usage: molecule_readers_test.py ISOFIELD SHARED MOLECULES READERS
SHARED ($ISOFIELD_SHARED in its place, if that is set) is the folder with the files of others, MOLECULES the one with
the project's own. READERS is a folder for a virtual environment with gemmi and ase; it is made if it does not exist.
"""

import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from readers import loud, readers_python

SKIPPED = 77

# Van der Waals radii of the elements in the files; others have 2.0.
RADII = {"H": 1.2, "D": 1.2, "C": 1.7, "N": 1.55, "O": 1.52, "F": 1.47, "Na": 2.27, "P": 1.8, "S": 1.8, "Cl": 1.75,
         "Ca": 2.31, "Zn": 1.39, "Se": 1.9, "Br": 1.85}
NO_RADIUS = 2.0

# A program that takes a list of [reader, path, frame, assembly] and prints the atoms of each: [element, x, y, z].
READ_ATOMS = """
import json, sys
import ase.io, gemmi

def read(reader, path, frame, assembly):
    if reader == "ase":
        atoms = ase.io.read(path, index=frame - 1, format="extxyz")
        return [[a.symbol, *map(float, a.position)] for a in atoms]
    structure = gemmi.read_structure(path)
    if assembly:
        structure.transform_to_assembly(assembly, gemmi.HowToNameCopiedChain.AddNumber)
    return [[c.atom.element.name, *c.atom.pos.tolist()] for c in structure[frame - 1].all()]

print("\\n" + json.dumps([read(*wanted) for wanted in json.load(sys.stdin)]))
"""


def changed(path, name, change, folder):
    """Writes a copy of the file with the lines of its atoms changed, and returns its path."""
    made = folder / f"{path.stem}_{name}.pdb"
    lines = path.read_text().splitlines()
    made.write_text("".join((change(line) if line[:6] in ("ATOM  ", "HETATM") else line) + "\n" for line in lines))
    return made


def key(radius, place):
    # Scenes hold floats of 32 bits; the files have three decimals or more.
    return (round(radius, 3), *(round(c, 3) + 0.0 for c in place))


def imported(isofield, path, options, folder):
    out = folder / "scene.json"
    run = subprocess.run([isofield, "import", path, "-o", out, *options], capture_output=True, text=True)
    assert run.returncode == 0, f"{path}: {run.stderr}"
    spheres = [node["sphere"] for node in json.loads(out.read_text())["nodes"] if "sphere" in node]
    return collections.Counter(key(s["radius"], s["center"]) for s in spheres)


def main():
    isofield, shared, molecules, readers = sys.argv[1:]
    data = pathlib.Path(os.environ.get("ISOFIELD_SHARED", shared)) / "data"
    own = pathlib.Path(molecules)
    if not (data / "4hhb.pdb").exists():
        loud(f"SKIPPED, NOT PASSED: {data}/4hhb.pdb is missing (set ISOFIELD_SHARED)")
        sys.exit(SKIPPED)
    python = readers_python(readers, ["gemmi", "ase"], "SKIPPED, NOT PASSED")
    if python is None:
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="isofield-") as name:
        folder = pathlib.Path(name)
        whole = data / "4hhb.pdb"
        odd = data / "odd"
        # Each row holds the imported file, its options, the reader, the file that it reads, its frame and assembly.
        wanted = [
            (whole, [], "gemmi", whole, 1, ""),
            (changed(whole, "cut_77", lambda l: l[:76], folder), [], "gemmi", whole, 1, ""),
            (changed(whole, "cut_67", lambda l: l[:66], folder), [], "gemmi", whole, 1, ""),
            (changed(whole, "left", lambda l: l[:12] + l[12:16].strip().ljust(4) + l[16:66], folder), [], "gemmi",
             whole, 1, ""),
            (changed(whole, "shifted", lambda l: l[:6] + "1" + l[6:11].replace(" ", "0") + l[11:], folder), [], "gemmi",
             whole, 1, ""),
            (data / "1A8O.pdb", [], "gemmi", data / "1A8O.pdb", 1, ""),
            (data / "1A8O.cif", [], "gemmi", data / "1A8O.cif", 1, ""),
            (data / "1A8O.cif", [], "gemmi", data / "1A8O.pdb", 1, ""),
            (data / "1A8O.cif", ["--assembly", "1"], "gemmi", data / "1A8O.cif", 1, "1"),
            (data / "extended.xyz", [], "ase", data / "extended.xyz", 1, ""),
            (odd / "frames_by_end.pdb", [], "gemmi", odd / "frames_by_end.pdb", 1, ""),
            (odd / "packed.pdb.gz", [], "gemmi", odd / "packed.pdb.gz", 1, ""),
            (odd / "properties_pos_last.xyz", [], "ase", odd / "properties_pos_last.xyz", 1, ""),
            (own / "models.pdb", ["--model", "2"], "gemmi", own / "models.pdb", 2, ""),
            (own / "assembly.pdb", ["--assembly", "1"], "gemmi", own / "assembly.pdb", 1, "1"),
            (own / "chains.pdb", [], "gemmi", own / "chains.pdb", 1, ""),
            (own / "deuterium.pdb", [], "gemmi", own / "deuterium.pdb", 1, ""),
            (own / "hybrid_36.pdb", [], "gemmi", own / "hybrid_36.pdb", 1, ""),
            (own / "properties_pos_last.xyz", [], "ase", own / "properties_pos_last.xyz", 1, ""),
        ]
        queries = [[reader, str(path), frame, assembly] for _, _, reader, path, frame, assembly in wanted]
        run = subprocess.run([python, "-c", READ_ATOMS], input=json.dumps(queries), capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        answers = json.loads(run.stdout.splitlines()[-1])
        failures = []
        print(f"{'file':32} {'options':16} {'reader':6} {'reads':24} {'atoms':>6}  elements")
        for (path, options, reader, read, _, _), atoms in zip(wanted, answers):
            expected = collections.Counter(key(RADII.get(element, NO_RADIUS), place) for element, *place in atoms)
            found = imported(isofield, path, ["--waters", *options], folder)
            elements = collections.Counter(element for element, *_ in atoms)
            print(f"{path.name:32} {' '.join(options):16} {reader:6} {read.name:24} {found.total():6}  "
                  f"{dict(elements)}")
            if found != expected or not atoms:
                failures.append(f"{path.name}: {found.total()} atoms, {reader} reads {len(atoms)}; only here: "
                                f"{list((found - expected))[:3]}; only there: {list((expected - found))[:3]}")
    assert not failures, "\n".join(failures)


if __name__ == "__main__":
    main()
