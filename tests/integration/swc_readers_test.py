"""Compares what `isofield import` reads of neurons with what two other readers read: morphio counts the neurites, their
sections and the edges of these, navis the trees and the nodes. Every difference is explained in a table below.
A difference without an explanation, or an explanation that does not hold, is a failure.

Usage: swc_readers_test.py ISOFIELD SHARED READERS
SHARED ($ISOFIELD_SHARED in its place, if that is set) is the folder with the files. READERS is a folder for a virtual
environment with morphio and navis; it is made if it does not exist. If they cannot be installed, the test is
skipped. It needs no server.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from readers import loud, readers_python

SKIPPED = 77
PACKAGES = ["morphio>=3.5", "navis>=1.12"]

# A program that prints an object with the counts of both readers for each file, or None where a reader refuses the
# file.
COUNT = """
import json, logging, os, sys, warnings
warnings.filterwarnings("ignore")
logging.disable(logging.CRITICAL)
import morphio, navis
navis.set_pbars(hide=True)
def by_morphio(path):
    m = morphio.Morphology(path)
    # A section repeats the point that it begins at: its parent's last one.
    edges = sum(len(s.points) - 1 for s in m.iter())
    return {"neurites": len(m.root_sections), "sections": len(m.sections), "edges": edges,
            "soma": len(m.soma.points)}
def by_navis(path):
    n = navis.read_swc(path)
    return {"trees": int(n.n_trees), "nodes": int(n.n_nodes)}
def or_none(reader, path):
    try:
        return reader(path)
    except Exception:
        return None
print("\\n" + json.dumps({path: [or_none(by_morphio, path), or_none(by_navis, path)] for path in sys.argv[1:]}))
"""

# Files that morphio refuses, and why; isofield reports the damage and imports the rest.
MORPHIO_REFUSES = {
    "Neuron_missing_ids.swc": "samples 8 and 9 have the parent 7, which is missing",
    "multiple_soma.swc": "two somata",
    "multiple_somata.swc": "two somata",
    "repeated_id.swc": "the id 4 is used twice",
    "soma__bifurcating_soma.swc": "the soma branches",
    "soma_with_neurite_parent.swc": "the soma's parent is a neurite",
    "hemibrain_1734350788.swc": "the soma's parent is a neurite",
    "hemibrain_1734350908.swc": "the soma's parent is a neurite",
    "ids_beyond_53_bits.swc": "ids beyond 32 bits",
}

# Files that navis does not read, and why.
NAVIS_REFUSES = {
    "Neuron_missing_ids.swc": "samples 8 and 9 have the parent 7, which is missing",
    "multiple_somata.swc": "a comment at the end of a line",
    "neurite_wrong_root_point.swc": "a comment at the end of a line",
    "repeated_id.swc": "a comment at the end of a line",
    "root_node_jump.swc": "a comment at the end of a line",
    "soma_with_neurite_parent.swc": "a comment at the end of a line",
    "z_jump.swc": "a comment after a blank line at the end",
}

# This table has, for each file, the number of morphio's edges minus isofield's, and why they differ.
MORPHIO_DIFFERENCES = {
    "Neuron-monotonic.swc": (-80, "the file repeats each of the 80 points where a section begins; morphio leaves out "
                             "the edges of length 0, isofield reports them"),
}


def read_samples(path):
    """Returns type and parent by id. They say which pieces belong to neurites; the counts under test are isofield's."""
    samples = {}
    for line in path.read_text(errors="replace").splitlines():
        fields = line.split("#")[0].replace(",", " ").split()
        if len(fields) >= 7:
            samples.setdefault(int(fields[0]), (int(fields[1]), int(fields[6])))
    return samples


def count_by_isofield(isofield, path, folder):
    """Returns the samples and trees by the report, and the edges between samples of neurites. These are the pieces of
    the scene that are named after one, and what the report says was left out, without the edges from a soma."""
    scene_file = f"{folder}/scene.json"
    run = subprocess.run([isofield, "--json", "import", path, "-o", scene_file], capture_output=True, text=True)
    assert run.returncode == 0, f"{path}: {run.stderr}"
    report = json.loads(run.stdout)["report"]

    def found(words):
        return sum(int(count) for what, count in report["findings"].items() if words in what)

    samples = read_samples(path)
    names = {node.get("name", "") for node in json.loads(pathlib.Path(scene_file).read_text())["nodes"]}
    neurites = {sample: parent for sample, (kind, parent) in samples.items() if kind != 1}
    made = sum(1 for sample, parent in neurites.items() if parent in samples and f"n{sample}" in names)
    left_out = found("edge within the soma") + found("edge of length 0 dropped")
    from_soma = sum(1 for parent in neurites.values() if samples.get(parent, (0, 0))[0] == 1)
    return {"read": int(report["read"]), "trees": found("separate tree") or 1, "edges": made + left_out - from_soma,
            "soma": len(samples) - len(neurites)}


def main():
    isofield, shared, readers = sys.argv[1:]
    data = pathlib.Path(os.environ.get("ISOFIELD_SHARED", shared)) / "data"
    files = [*sorted(data.glob("swc/*.swc")), *sorted(data.glob("odd/*.swc")), *sorted(data.glob("hemibrain_*.swc"))]
    if not files:
        loud(f"SKIPPED, NOT PASSED: {data}/swc is missing (set ISOFIELD_SHARED)")
        sys.exit(SKIPPED)
    python = readers_python(readers, PACKAGES, "SKIPPED, NOT PASSED")
    if python is None:
        sys.exit(SKIPPED)
    run = subprocess.run([python, "-c", COUNT, *map(str, files)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    counted = json.loads(run.stdout.splitlines()[-1])
    failures = []

    def expect(path, what, found, expected):
        if found != expected:
            failures.append(f"{path.name}: {what}: {found}, expected {expected}")

    print(f"{'file':34} {'read':>5} {'trees':>5} {'edges':>5}  morphio, navis")
    with tempfile.TemporaryDirectory(prefix="isofield-") as folder:
        for path in files:
            ours = count_by_isofield(isofield, path, folder)
            morphio, navis = counted[str(path)]
            print(f"{path.name:34} {ours['read']:5} {ours['trees']:5} {ours['edges']:5}  "
                  f"{morphio or 'refused: ' + MORPHIO_REFUSES.get(path.name, '?')}, "
                  f"{navis or 'refused: ' + NAVIS_REFUSES.get(path.name, '?')}", flush=True)
            expect(path, "refused by morphio", morphio is None, path.name in MORPHIO_REFUSES)
            expect(path, "refused by navis", navis is None, path.name in NAVIS_REFUSES)
            if navis:
                expect(path, "trees by isofield", ours["trees"], navis["trees"])
                expect(path, "samples by isofield", ours["read"], navis["nodes"])
            if morphio:
                more, why = MORPHIO_DIFFERENCES.get(path.name, (0, ""))
                if why:
                    print(f"    {more:+} edges by morphio: {why}")
                expect(path, "edges by isofield", ours["edges"], morphio["edges"] - more)
                expect(path, "samples of somata by isofield", ours["soma"], morphio["soma"])
    assert not failures, "\n".join(failures)


if __name__ == "__main__":
    main()
