#!/usr/bin/python3
"""Reads the #include lines of server/ and fails if a room of the house includes a file that it may not include.

Usage: arrows_test.py SERVER_FOLDER
"""

import os
import re
import sys
import tempfile
import unittest

# The rooms that each room may include, beside itself and base. The arrows point down: a room includes no room above it.
BLOBTREE = ["blobtree/geometry", "blobtree/primitives", "blobtree/scene", "blobtree/tape", "blobtree/cull"]
BELOW_ENGINE = BLOBTREE + ["operators", "gpu", "shaders"]
ENGINE_ROOMS = ["engine/kernels", "engine/residency", "engine/points", "engine/mesh", "engine/simplify",
                "engine/surface"]
ARROWS = {
    "main": ["daemon"],
    "daemon": ["rpc", "scenes", "catalog", "engine"] + ENGINE_ROOMS,
    "rpc": ["scenes", "catalog", "engine", "engine/session"] + ENGINE_ROOMS + BLOBTREE + ["operators"],
    "scenes": ["catalog", "engine", "operators"] + BLOBTREE,
    "catalog": BLOBTREE + ["operators"],
    "reference": BLOBTREE + ["operators"],
    # The facade may include the rooms that it joins.
    "engine": ENGINE_ROOMS + ["engine/session"] + BELOW_ENGINE,
    "engine/surface": ["engine/mesh", "engine/points", "engine/kernels", "engine/residency", "engine/session"]
                      + BELOW_ENGINE,
    "engine/simplify": ["engine/mesh"] + BELOW_ENGINE,
    "engine/mesh": ["engine/kernels", "engine/residency", "engine/session"] + BELOW_ENGINE,
    "engine/points": ["engine/residency", "engine/kernels", "engine/session"] + BELOW_ENGINE,
    "engine/residency": ["engine/kernels", "engine/session"] + BELOW_ENGINE,
    "engine/kernels": ["engine/session"] + BELOW_ENGINE,
    "engine/session": BELOW_ENGINE,
    "blobtree/cull": ["blobtree/tape", "blobtree/scene", "blobtree/primitives", "blobtree/geometry", "operators"],
    "blobtree/tape": ["blobtree/scene", "blobtree/primitives", "blobtree/geometry", "operators"],
    "blobtree/scene": ["blobtree/primitives", "blobtree/geometry", "operators"],
    "blobtree/primitives": ["blobtree/geometry", "operators"],
    "blobtree/geometry": [],
    "operators": [],
    "gpu": [],
    "base": [],
}
# These files lie in engine/ itself but below its rooms. The other files of engine/ are its facade.
SESSION_FILES = ["session", "request_times", "dealing"]

# Libraries and generated headers from elsewhere, with the only rooms that may include them.
OUTSIDE = [
    (re.compile(r"vulkan/"), ["gpu"]),
    (re.compile(r"(grpc|grpcpp)/|isofield/v1/.*\.grpc\.pb\.h$"), ["rpc", "daemon"]),
    (re.compile(r"isofield/v1/.*_service\.pb\.h$"), ["rpc"]),
]

MOST_LINES = 350
MOST_ENGINE_FILES = 12

INCLUDE = re.compile(r'\s*#\s*include\s+["<]([^">]+)[">]')


def room_of(path):
    """Returns the room of a file, whose path begins in server/, or None for what comes from elsewhere."""
    parts = path.split("/")
    if len(parts) == 1:
        return "main" if path == "main.cpp" else None
    if parts[0] == "engine" and len(parts) == 2:
        return "engine/session" if os.path.splitext(parts[1])[0] in SESSION_FILES else "engine"
    if parts[0] in ("engine", "blobtree") and len(parts) > 2:
        return "/".join(parts[:2])
    return parts[0] if parts[0] in ARROWS or parts[0] == "shaders" else None


def read_files(server):
    """Returns the lines of all sources by their paths."""
    files = {}
    for folder, _, names in os.walk(server):
        for name in names:
            if name.endswith((".h", ".cpp")):
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as source:
                    files[os.path.relpath(path, server)] = source.read().splitlines()
    return files


def includes_of(lines):
    return [match.group(1) for match in map(INCLUDE.match, lines) if match]


def arrow_faults(path, included):
    room = room_of(path)
    if room not in ARROWS:
        return [f"{path}: {room} is no room of the table in {os.path.basename(__file__)}"]
    for pattern, rooms in OUTSIDE:
        if pattern.match(included) and room not in rooms:
            return [f"{path} includes {included}, which only {' and '.join(rooms)} may include"]
    target = room_of(included)
    if target is None or target in (room, "base") or target in ARROWS[room]:
        return []
    return [f"{path} includes {included}, but {room} may not include {target}"]


def find_circle(graph):
    """Returns a list of nodes that leads back to its first one, or an empty list."""
    done = set()

    def follow(node, way):
        if node in way:
            return way[way.index(node):] + [node]
        if node in done:
            return []
        for other in graph.get(node, ()):
            circle = follow(other, way + [node])
            if circle:
                return circle
        done.add(node)
        return []

    for start in graph:
        circle = follow(start, [])
        if circle:
            return circle
    return []


def faults(server):
    files = read_files(server)
    found = []
    graph = {}
    for path, lines in sorted(files.items()):
        included = includes_of(lines)
        for other in included:
            found += arrow_faults(path, other)
        graph[path] = [other for other in included if other in files]
        if len(lines) > MOST_LINES:
            found.append(f"{path} has {len(lines)} lines, more than {MOST_LINES}")
    circle = find_circle(graph)
    if circle:
        found.append("a circle: " + " -> ".join(circle))
    engine_files = [path for path in files if path.startswith("engine/") and path.count("/") == 1]
    if len(engine_files) > MOST_ENGINE_FILES:
        found.append(f"engine/ holds {len(engine_files)} files of its own, more than {MOST_ENGINE_FILES}")
    return found


class Arrows(unittest.TestCase):
    """Tests the rules on small trees of files."""

    def faults_of(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for path, text in files.items():
                os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
                with open(os.path.join(folder, path), "w", encoding="utf-8") as source:
                    source.write(text)
            return faults(folder)

    def expect_fault(self, files, part):
        found = self.faults_of(files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_arrows_down_are_admitted(self):
        self.assertEqual(self.faults_of({
            "rpc/a.cpp": '#include "scenes/b.h"\n#include <vector>\n#include "isofield/v1/field_service.grpc.pb.h"\n',
            "scenes/b.h": '#include "base/status_macros.h"\n#include "catalog/c.h"\n#include "engine/engine.h"\n',
            "engine/points/d.h": '#include "engine/session.h"\n',
            "gpu/e.h": "#include <vulkan/vulkan_raii.hpp>\n",
        }), [])

    def test_arrows_up_and_across_are_not(self):
        for path, included in [("scenes/a.h", "rpc/b.h"), ("catalog/a.h", "engine/engine.h"),
                               ("engine/points/a.h", "engine/mesh/b.h"), ("engine/mesh/a.h", "engine/engine.h"),
                               ("engine/session.h", "engine/kernels/a.h"), ("blobtree/tape/a.h", "blobtree/cull/b.h"),
                               ("blobtree/primitives/a.h", "blobtree/scene/b.h"), ("gpu/a.h", "operators/b.h"),
                               ("operators/a.h", "blobtree/geometry/b.h"), ("base/a.h", "gpu/b.h"),
                               ("engine/a.h", "reference/b.h")]:
            self.expect_fault({path: f'#include "{included}"\n'}, included)

    def test_libraries_have_their_rooms(self):
        self.expect_fault({"engine/a.h": "#include <vulkan/vulkan.h>\n"}, "only gpu")
        self.expect_fault({"scenes/a.h": "#include <grpcpp/grpcpp.h>\n"}, "only rpc and daemon")
        self.expect_fault({"scenes/a.h": '#include "isofield/v1/scene_service.pb.h"\n'}, "only rpc")

    def test_a_new_room_needs_a_line(self):
        self.expect_fault({"engine/attic/a.h": '#include "base/b.h"\n'}, "engine/attic is no room")

    def test_circles_are_found(self):
        self.expect_fault({"rpc/a.h": '#include "rpc/b.h"\n', "rpc/b.h": '#include "rpc/c.h"\n',
                           "rpc/c.h": '#include "rpc/a.h"\n'}, "rpc/a.h -> rpc/b.h -> rpc/c.h -> rpc/a.h")

    def test_the_table_has_no_circle(self):
        self.assertEqual(find_circle(ARROWS), [])

    def test_files_are_short_and_few(self):
        self.expect_fault({"rpc/a.h": "\n" * (MOST_LINES + 1)}, "351 lines")
        self.assertEqual(self.faults_of({"rpc/a.h": "\n" * MOST_LINES}), [])
        self.expect_fault({f"engine/a{i}.h": "" for i in range(MOST_ENGINE_FILES + 1)}, "13 files")


class Server(unittest.TestCase):
    folder = ""

    def test_has_no_faults(self):
        found = faults(self.folder)
        if found:
            self.fail("\n" + "\n".join(found))


if __name__ == "__main__":
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    Server.folder = sys.argv.pop()
    unittest.main()
