"""Starts a daemon for Python tests, and makes modules from the .proto files alone, as users of other languages do."""

import contextlib
import pathlib
import signal
import subprocess
import sys
import tempfile

import grpc
import numpy as np


def generate(protoc, protos, out):
    files = sorted(pathlib.Path(protos).glob("isofield/v1/*.proto"))
    subprocess.run([protoc, f"-I{protos}", f"--python_out={out}", f"--grpc_out={out}",
                    "--plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin", *map(str, files)], check=True)
    sys.path.insert(0, out)


def start_daemon(isofieldd, address):
    """Returns a running daemon and the address that it serves, with the real port if the stated one is 0."""
    daemon = subprocess.Popen([isofieldd, "--listen", address, "--validation"], stderr=subprocess.PIPE, text=True)
    for line in daemon.stderr:
        if "listening on" in line:
            return daemon, line.split("listening on ")[1].strip()
    sys.exit(f"isofieldd does not start: exit code {daemon.wait()}")


def stop_daemon(daemon):
    """Stops the daemon. Fails if it exits with an error or the Vulkan validation layer has said anything."""
    daemon.send_signal(signal.SIGTERM)
    _, log = daemon.communicate()
    assert daemon.returncode == 0, f"exit code {daemon.returncode}\n{log}"
    assert "Vulkan validation:" not in log, log


@contextlib.contextmanager
def served(isofieldd, protoc, protos):
    """Yields a channel to a daemon that serves until the end of the block; modules isofield.v1.* can be imported then.
    No option of the channel is set. Fails as stop_daemon does."""
    with tempfile.TemporaryDirectory(prefix="isofield-") as folder:
        generate(protoc, protos, folder)
        address = f"unix:{folder}/s"
        daemon, _ = start_daemon(isofieldd, address)
        try:
            with grpc.insecure_channel(address) as channel:
                yield channel
        finally:
            stop_daemon(daemon)


def array(tensor):
    """Returns the numbers of a Tensor message."""
    dtype = {1: "<f4", 2: "<f8", 3: "<u4", 4: "u1"}[tensor.dtype]
    return np.frombuffer(tensor.data, dtype).reshape(tuple(tensor.shape))
