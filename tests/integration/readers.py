"""Makes an environment with other readers of the files, for tests that compare isofield's reading with theirs."""

import pathlib
import subprocess
import sys


def loud(text):
    print(f"\n******** {text} ********\n", file=sys.stderr, flush=True)


def readers_python(folder, packages, otherwise):
    """Returns the interpreter of a virtual environment with the packages, which is made in the folder on first use.

    Returns None if they cannot be installed; `otherwise` then says loudly what that means for the test.
    """
    folder = pathlib.Path(folder).absolute()
    python = folder / "bin" / "python"
    complete = folder / "complete"
    if not complete.exists():
        try:
            subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True, capture_output=True)
            subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True, capture_output=True,
                           timeout=600)
        except (OSError, subprocess.SubprocessError) as error:
            loud(f"{otherwise}: {' and '.join(packages)} cannot be installed ({error})")
            return None
        complete.touch()
    return python
