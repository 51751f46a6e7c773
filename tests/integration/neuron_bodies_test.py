"""Meshes every neuron of shared/data at default options. Each mesh must have as many bodies as the file has trees, or a
warning must name the primitive that is too thin for the cells. Slivers, which the summary counts by themselves, are
warned of in the same way. Prints a table with the seconds and the daemon's peak memory of each.

Usage: neuron_bodies_test.py ISOFIELDD ISOFIELD SHARED READERS
SHARED ($ISOFIELD_SHARED in its place, if that is set) is the folder with the files. READERS is a folder for a virtual
environment with navis, which counts the trees; it is made if it does not exist. If navis cannot be installed, or does
not read a file, the roots are counted here, and the table says so.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

from readers import loud, readers_python

SKIPPED = 77
UNCOUNTED = "THE TREES ARE COUNTED BY THIS TEST ALONE"

# This program prints an object with the number of trees that navis finds in each file. It leaves out files that navis
# does not read.
COUNT_TREES = """
import json, logging, sys, warnings
warnings.filterwarnings("ignore")
logging.disable(logging.CRITICAL)
import navis
navis.set_pbars(hide=True)
found = {}
for path in sys.argv[1:]:
    try:
        found[path] = int(navis.read_swc(path).n_trees)
    except Exception:
        pass
print("\\n" + json.dumps(found))
"""


def count_by_readers(python, files):
    if python is None:
        return {}
    run = subprocess.run([python, "-c", COUNT_TREES, *map(str, files)], capture_output=True, text=True)
    if run.returncode != 0:
        loud(f"{UNCOUNTED}: navis fails: {run.stderr[-400:]}")
        return {}
    return json.loads(run.stdout.splitlines()[-1])


def count_roots(path):
    """Counts samples whose parent is not in the file or is the sample itself; the first sample of each id counts."""
    parents = {}
    for line in path.read_text(errors="replace").splitlines():
        fields = line.replace(",", " ").split()
        if len(fields) >= 7 and not fields[0].startswith("#"):
            parents.setdefault(int(float(fields[0])), int(float(fields[6])))
    return sum(1 for sample, parent in parents.items() if parent == sample or parent not in parents)


class Daemon:
    def __init__(self, isofieldd, address):
        self.process = subprocess.Popen([isofieldd, "--listen", address], stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if "listening on" in line:
                return
        sys.exit(f"isofieldd does not start: exit code {self.process.wait()}")

    def peak_mib(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024
        return 0

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        _, log = self.process.communicate()
        assert self.process.returncode == 0, f"exit code {self.process.returncode}\n{log}"


def mesh(isofieldd, isofield, path, folder):
    """Meshes the file with a daemon of its own, so that the daemon's peak of memory is that of the file."""
    address = f"unix:{folder}/s"
    daemon = Daemon(isofieldd, address)
    try:
        begin = time.monotonic()
        run = subprocess.run([isofield, "--server", address, "--json", "mesh", path, "-o", f"{folder}/mesh.glb"],
                             capture_output=True, text=True)
        seconds = time.monotonic() - begin
        peak = daemon.peak_mib()
    finally:
        daemon.stop()
    assert run.returncode == 0, f"{path}: {run.stderr}"
    return json.loads(run.stdout), seconds, peak


def main():
    isofieldd, isofield, shared, readers = sys.argv[1:]
    data = pathlib.Path(os.environ.get("ISOFIELD_SHARED", shared)) / "data"
    files = sorted(data.glob("swc/*.swc")) + sorted(data.glob("hemibrain_*.swc"))
    if not files:
        loud(f"SKIPPED, NOT PASSED: {data}/swc is missing (set ISOFIELD_SHARED)")
        sys.exit(SKIPPED)
    counted = count_by_readers(readers_python(readers, ["navis"], UNCOUNTED), files)
    failures = []
    print(f"{'file':34} {'trees':>5} {'by':6} {'bodies':>6} {'voids':>5} {'cell':>9} {'seconds':>7} {'MiB':>5}  warning")
    for path in files:
        own = count_roots(path)
        reader, trees = ("navis", counted[str(path)]) if str(path) in counted else ("roots", own)
        with tempfile.TemporaryDirectory(prefix="isofield-") as folder:
            answer, seconds, peak = mesh(isofieldd, isofield, path, folder)
        summary = answer["summary"]
        bodies, voids = int(summary["bodies"]), int(summary["voids"])
        thin = summary.get("too_thin")
        slivers = summary.get("slivers", {"bodies": 0, "voids": 0})
        warning = f"{thin['node']} of {thin['primitives']}, {thin['thickness']:.3g} across" if thin else ""
        if "node" in slivers:
            warning += f" slivers: {slivers['bodies']} bodies, {slivers['voids']} voids, near {slivers['node']}"
        print(f"{path.name:34} {trees:5} {reader:6} {bodies:6} {voids:5} {summary['cell_size']:9.4g} {seconds:7.2f} "
              f"{peak:5.0f}  {warning}", flush=True)
        if trees != own:
            print(f"    {reader} counts {trees} trees, the roots are {own}")
        for node in [part["node"] for part in (thin, slivers) if part and "node" in part]:
            if not any(f"{node}" in text for text in answer["warnings"]):
                failures.append(f"{path.name}: no warning names {node}: {answer['warnings']}")
        bodies -= int(slivers["bodies"])
        if thin:
            continue
        if bodies > trees or bodies == 0:
            failures.append(f"{path.name}: {bodies} bodies of {trees} trees, and no primitive is said to be too thin")
        elif bodies < trees:
            print("    trees that touch are one body")
    assert not failures, "\n".join(failures)


if __name__ == "__main__":
    main()
