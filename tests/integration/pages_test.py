"""Runs the commands of every page of the project in order, as a reader would, and checks what else pages refer to.

Usage: pages_test.py BIN CHECKOUT FOLDER
BIN has the built programs, in a build folder that CTest knows. FOLDER keeps compiled kernels from one run to the next,
and may hold grpcurl/grpcurl.

The pages are README.md, */README.md, tests/bench/README.md, client/examples/*/README.md and .github/*.md. Each is run
by one bash, with `set -euo pipefail`, in a copy of the checkout of its own, where build/bin is BIN. ISOFIELD_LISTEN and
ISOFIELD_SERVER name a free port, which also replaces 127.0.0.1:50051 in the text. Fenced blocks are, by what follows
the three backticks:

    sh               run. A line `isofieldd ... &` starts a daemon, and is done when that listens.
    sh with NAME     run where the program NAME is there, and loudly left out elsewhere.
    sh no-test       not run; the line above is `<!-- Not run by the test: REASON -->`.
    python           run by python3.
    json, json FILE  parsed. FILE of the checkout must hold the same; a FILE that is not there is written.
    toml FILE        written to FILE.
    cmake FILE, cpp FILE, proto FILE   each line must be one of FILE of the checkout.
    text             for reading alone.

Indented blocks are refused, for they could escape. The page that client/examples/figures/make writes has its commands
in a table; those that draw do so beside the model, where there is nothing to draw, since pictures take seconds.

Names of tests and of benchmarks must exist: those after --gtest_filter, -R and --filter, those in table columns headed
`filter`, where a name without a program's is one of isofield_gpu_tests, and those in columns headed `benchmarks`. A name
in capitals is a placeholder. Links must lead to files of the
checkout, and README.md must stay short.
"""

import fnmatch
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

DEFAULT_ADDRESS = "127.0.0.1:50051"
FIGURES = "client/examples/figures/README.md"
README_BYTES = 8192
COLUMNS = 120
SECONDS = 300  # for one page; a first run compiles kernels
HEREDOC = "END_OF_THE_BLOCK"

# Sourced by the bash of each page: how daemons start, and where a command failed. Lines of the script are the page's.
PREAMBLE = """
unset BASH_ENV
set -euo pipefail
trap 'echo "$PAGE:$LINENO: exit code $?: $BASH_COMMAND" >&2' ERR
daemons=()
stop_daemons() {
  local code=$? daemon
  for daemon in "${daemons[@]}"; do
    { kill "$daemon" && wait "$daemon"; } || { echo "$PAGE: a daemon ended with an error" >&2; code=1; }
  done
  exit $code
}
trap stop_daemons EXIT
start_daemon() {
  local log line said
  log=$(mktemp -u)
  mkfifo "$log"
  "$@" 2>"$log" &
  daemons+=($!)
  exec {said}<"$log"
  rm "$log"
  while read -r line <&$said; do
    case $line in *"listening on"*) cat <&$said >/dev/null & exec {said}<&-; return 0 ;; esac
    echo "$line"
  done
  return 1
}
"""


class Faults:
    """What is wrong with the pages, by page and line."""

    def __init__(self):
        self.found = []

    def add(self, page, line, text):
        if text:
            self.found.append(f"{page}:{line}: {text}")


def pages(checkout):
    patterns = "README.md", "*/README.md", "tests/bench/README.md", "client/examples/*/README.md", ".github/*.md"
    found = {path for pattern in patterns for path in checkout.glob(pattern)}
    return sorted(str(path.relative_to(checkout)) for path in found if not path.parent.name.startswith("build"))


class Block:
    """A fenced block: its info string as words, the number of its opening line, from 1, and its lines."""

    def __init__(self, info, number):
        self.words, self.number, self.lines = info.split(), number, []

    @property
    def language(self):
        return self.words[0] if self.words else ""


def fenced_blocks(page, lines, faults):
    """The blocks, and the lines outside of them with their numbers. Indented blocks are faults."""
    blocks, outside, block = [], [], None
    for number, line in enumerate(lines, 1):
        if block is None and line.startswith("```"):
            block = Block(line[3:], number)
            outside.append((number, ""))
        elif block is not None and line.rstrip() == "```":
            blocks.append(block)
            block = None
        elif block is not None:
            block.lines.append(line)
        else:
            if "```" in line:
                faults.add(page, number, "a fence that is not at the line's beginning")
            if line.startswith(("    ", "\t")) and line.strip() and not lines[number - 2].strip():
                faults.add(page, number, "an indented block; fence it, so that the test sees it")
            outside.append((number, line))
    if block is not None:
        faults.add(page, block.number, "a block without an end")
    return blocks, outside


def is_excused(lines, block):
    above = lines[block.number - 2] if block.number > 1 else ""
    return re.fullmatch(r"<!-- Not run by the test: .{10,} -->", above) is not None


class Script:
    """A page's commands as bash, each on the page's own line."""

    def __init__(self, count):
        self.lines = [""] * (count + 1)
        self.commands = 0

    def put(self, number, line):
        self.lines[number] = line

    def shell(self, block):
        for number, line in enumerate(block.lines, block.number + 1):
            started = re.fullmatch(r"((?:\w+=\S+ )*(?:\S*/)?isofieldd\b[^#&]*)&\s*(#.*)?", line)
            self.put(number, f"start_daemon env {started[1]}" if started else line)
            self.commands += bool(line.strip()) and not line.lstrip().startswith("#")

    def heredoc(self, command, block):
        self.put(block.number, f"{command} <<'{HEREDOC}'")
        for number, line in enumerate(block.lines, block.number + 1):
            self.put(number, line)
        self.put(block.number + len(block.lines) + 1, HEREDOC)
        self.commands += 1

    def text(self):
        return "\n".join(self.lines[1:]) + "\n"


def check_lines_of(page, block, checkout, faults):
    there = {line.strip() for line in (checkout / block.words[1]).read_text().splitlines()}
    for number, line in enumerate(block.lines, block.number + 1):
        if line.strip() and line.strip() not in there:
            faults.add(page, number, f"not a line of {block.words[1]}: {line.strip()}")


def add_json(page, block, checkout, script, faults):
    try:
        value = json.loads("\n".join(block.lines))
    except ValueError as error:
        faults.add(page, block.number, f"not JSON: {error}")
        return
    if len(block.words) < 2:
        return
    file = checkout / block.words[1]
    if not file.exists():
        script.heredoc(f"cat >{block.words[1]}", block)
    elif json.loads(file.read_text()) != value:
        faults.add(page, block.number, f"not what {block.words[1]} holds")


def script_of(page, lines, checkout, faults):
    """The page's commands, and what is left out of them with the reason."""
    script, left_out = Script(len(lines)), []
    blocks, outside = fenced_blocks(page, lines, faults)
    for block in blocks:
        kind, words = block.language, block.words[1:]
        if kind == "sh" and words == ["no-test"]:
            if is_excused(lines, block):
                left_out.append(f"{page}:{block.number}: {lines[block.number - 2][5:-4]}")
            else:
                faults.add(page, block.number, "no reason on the line above: <!-- Not run by the test: REASON -->")
        elif kind == "sh" and len(words) == 2 and words[0] == "with":
            if shutil.which(words[1]):
                script.shell(block)
            else:
                left_out.append(f"{page}:{block.number}: ******** LEFT OUT, NOT PASSED: there is no {words[1]}")
        elif kind == "sh" and not words:
            script.shell(block)
        elif kind == "python" and not words:
            script.heredoc("/usr/bin/python3 -", block)
        elif kind == "json":
            add_json(page, block, checkout, script, faults)
        elif kind == "toml" and len(words) == 1:
            script.heredoc(f"cat >{words[0]}", block)
        elif kind in ("cmake", "cpp", "proto") and len(words) == 1:
            check_lines_of(page, block, checkout, faults)
        elif kind != "text":
            faults.add(page, block.number, f"a block of an unknown kind: {' '.join(block.words)!r}")
    return script, left_out, outside


def figures_script(lines):
    """Of the gallery, whose commands are code in a table and run in its folder."""
    script = Script(len(lines))
    script.put(1, f"cd {pathlib.PurePath(FIGURES).parent}; start_daemon isofieldd")
    beside = "--bounds 900,900,900,901,901,901"
    for number, line in enumerate(lines, 1):
        commands = re.findall(r"`(isofield [^`]*)`", line)
        script.commands += len(commands)
        if commands:
            script.put(number, "; ".join(f"{c} {beside}" if c.startswith("isofield render") else c for c in commands))
    return script


def free_address():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"127.0.0.1:{probe.getsockname()[1]}"


def run(page, script, checkout, binaries, folder):
    """Runs a page's commands; what they said, where one failed."""
    address = free_address()
    with tempfile.TemporaryDirectory(prefix="isofield-pages-") as scratch:
        copy = pathlib.Path(scratch, "isofield")
        left = shutil.ignore_patterns(".git", "build*", "quickstart-out", "__pycache__")
        shutil.copytree(checkout, copy, ignore=left)
        (copy / "build").mkdir()
        (copy / "build/bin").symlink_to(binaries)
        preamble = pathlib.Path(scratch, "preamble")
        preamble.write_text(PREAMBLE)
        program = pathlib.Path(scratch, "script")
        program.write_text(script.text().replace(DEFAULT_ADDRESS, address))
        environment = {**os.environ, "BASH_ENV": str(preamble), "PAGE": page, "ISOFIELD_LISTEN": address,
                       "ISOFIELD_SERVER": address, "ISOFIELD_DATA_DIR": str(folder / "pages")}
        with open(copy.parent / "said", "w+", errors="replace") as said:
            process = subprocess.Popen(["bash", str(program)], cwd=copy, env=environment, stdin=subprocess.DEVNULL,
                                       stdout=said, stderr=subprocess.STDOUT, start_new_session=True)
            try:
                code = process.wait(timeout=SECONDS)
            except subprocess.TimeoutExpired:
                code = f"not done within {SECONDS} seconds"
            try:  # what it left behind
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
            except ProcessLookupError:
                pass
            said.seek(0)
            return f"{said.read()}{code}" if code else None


class Names:
    """The tests and benchmarks that there are."""

    def __init__(self, binaries):
        self.binaries = binaries
        self.listed = {}

    def of_program(self, program):
        if program not in self.listed:
            listing = subprocess.run([self.binaries / program, "--gtest_list_tests"], check=True, capture_output=True,
                                     text=True).stdout
            names, suite = [], ""
            for line in listing.splitlines():
                name = line.split("#")[0].rstrip()
                if name.startswith("  "):
                    names.append(suite + name.strip())
                elif name.endswith("."):
                    suite = name
            self.listed[program] = names
        return self.listed[program]

    def of_ctest(self):
        """From a folder of its own, since ctest writes a log into the one that it is asked of."""
        if "ctest" not in self.listed:
            with tempfile.TemporaryDirectory(prefix="isofield-pages-") as scratch:
                build = self.binaries.resolve().parent
                pathlib.Path(scratch, "CTestTestfile.cmake").write_text(f'subdirs("{build}")\n')
                shown = subprocess.run(["ctest", "--test-dir", scratch, "--show-only=json-v1"], check=True,
                                       capture_output=True, text=True).stdout
            self.listed["ctest"] = [test["name"] for test in json.loads(shown)["tests"]]
        return self.listed["ctest"]

    def missing_of_gtest(self, program, pattern):
        """The first part of a filter that no test has, or None."""
        for part in pattern.split("-")[0].split(":"):
            if not any(fnmatch.fnmatchcase(name, part) for name in self.of_program(program)):
                return f"no test of {program} is called {part}"
        return None

    def missing_of_ctest(self, pattern):
        return None if any(re.search(pattern, name) for name in self.of_ctest()) else f"no test of CTest is {pattern}"

    def missing_of_bench(self, pattern):
        if pattern in ("clients", "transport"):
            return None
        listed = subprocess.run([self.binaries / "isofield_bench", "--benchmark_list_tests",
                                 f"--benchmark_filter={pattern}"], capture_output=True, text=True).stdout
        return None if re.search(r"^[\w.-]+[/\w]", listed, re.M) else f"no benchmark is called {pattern}"


def check_names(page, lines, outside, names, faults):
    quoted = r"""(?:'([^']+)'|([^\s'`|]+))"""
    ways = ((r"(isofield_\w+_tests)\b[^`]*?--gtest_filter=" + quoted, names.missing_of_gtest),
            (r"()\bctest\b[^`]*? -R " + quoted, lambda _, name: names.missing_of_ctest(name)),
            (r"()tests/bench/run[^`]*? --filter " + quoted, lambda _, name: names.missing_of_bench(name)))
    for number, line in enumerate(lines, 1):
        for pattern, missing in ways:
            for program, name, bare_name in re.findall(pattern, line):
                if not (name or bare_name).isupper():
                    faults.add(page, number, missing(program, name or bare_name))
    for number, text in code_of_column(outside, "filter"):
        words = text.split()
        if words[0] != "ctest":  # which is seen above
            program = words[0] if len(words) == 2 else "isofield_gpu_tests"
            faults.add(page, number, names.missing_of_gtest(program, words[-1]))
    for number, text in code_of_column(outside, "benchmarks"):
        faults.add(page, number, names.missing_of_bench(text))


def code_of_column(outside, heading):
    """The code in all table columns of this heading, with the numbers of the lines."""
    column = None
    for number, line in outside:
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if not line.startswith("|"):
            column = None
        elif heading in cells:
            column = cells.index(heading)
        elif column is not None and column < len(cells):
            for text in re.findall(r"`([^`]+)`", cells[column]):
                yield number, text


def check_links(page, outside, checkout, faults):
    for number, line in outside:
        targets = re.findall(r"\]\(([^)\s]+)\)", line) + re.findall(r'<img src="([^"]+)"', line)
        for target in targets:
            if re.match(r"\w+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = (checkout / page).parent / path if path else checkout / page
            if not file.exists():
                faults.add(page, number, f"a link to nothing: {target}")
            elif anchor and anchor not in anchors(file):
                faults.add(page, number, f"a link to a heading that is not there: {target}")


def anchors(file):
    """The headings of a page as links name them."""
    headings = re.findall(r"^#+ +(.*)$", file.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def check_form(page, lines, outside, faults):
    if page == FIGURES:
        return
    for number, line in enumerate(lines, 1):
        if len(line) > COLUMNS and not line.startswith("|"):
            faults.add(page, number, f"{len(line)} columns; at most {COLUMNS}")
    size = sum(len(line.encode()) + 1 for line in lines)
    if page == "README.md" and size > README_BYTES:
        faults.add(page, 1, f"{size} bytes; a newcomer's page has at most {README_BYTES}")


def main():
    binaries, checkout, folder = (pathlib.Path(argument).absolute() for argument in sys.argv[1:4])
    only = sys.argv[4:] or pages(checkout)  # by hand: some pages alone
    os.environ["PATH"] = f"{binaries}:{folder / 'grpcurl'}:{os.environ['PATH']}"
    names, faults = Names(binaries), Faults()
    for page in only:
        lines = (checkout / page).read_text().splitlines()
        script, left_out, outside = script_of(page, lines, checkout, faults)
        check_form(page, lines, outside, faults)
        check_links(page, outside, checkout, faults)
        check_names(page, lines, outside, names, faults)
        if page == FIGURES:
            script = figures_script(lines)
        started = time.monotonic()
        said = run(page, script, checkout, binaries, folder) if script.commands else None
        print(f"{page}: {script.commands} commands, {time.monotonic() - started:.1f} s", flush=True)
        for text in left_out:
            print(f"  {text}", flush=True)
        if said is not None:
            faults.add(page, 1, f"a command failed:\n{said[-3000:]}")
    if faults.found:
        sys.exit("\n".join(faults.found))


if __name__ == "__main__":
    main()
