#!/usr/bin/env python3
"""Evaluates a scene at random points, with nothing of isofield but its .proto files.

Once, from the project's root, generate the Python code (Debian: protobuf-compiler, protobuf-compiler-grpc,
python3-grpcio, python3-protobuf, python3-numpy):

    protoc -I proto --python_out=generated --grpc_out=generated \
        --plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin proto/isofield/v1/*.proto

or, with the grpcio-tools package: python3 -m grpc_tools.protoc -I proto --python_out=generated
--grpc_python_out=generated proto/isofield/v1/*.proto. Then, with isofieldd running:

    PYTHONPATH=generated client/examples/python/eval_points.py [--server ADDR] [--points N] [SCENE.json]
"""

import argparse
import time

import grpc
import numpy as np
from google.protobuf import json_format
from isofield.v1 import field_service_pb2, field_service_pb2_grpc, scene_pb2

CHUNK = 65536  # points: 768 KiB

EXAMPLE = """{"nodes": [
  {"name": "left",  "sphere": {"center": [-0.7, 0, 0], "radius": 0.8, "range": 0.6}},
  {"name": "right", "sphere": {"center": [0.7, 0, 0], "radius": 0.8, "range": 0.6}},
  {"name": "both",  "gradient": {"children": ["left", "right"], "opening": {"preset": "CAMEL"}}}]}"""


def tensor(points):
    """Returns an array of points [n, 3] as the Tensor message of scene.proto: bytes, type and shape."""
    points = np.ascontiguousarray(points, dtype="<f4")
    return scene_pb2.Tensor(dtype=scene_pb2.Tensor.FLOAT32, shape=points.shape, data=points.tobytes())


def array(message):
    """Returns the numbers of a Tensor message as an array."""
    types = {scene_pb2.Tensor.FLOAT32: "<f4", scene_pb2.Tensor.FLOAT64: "<f8", scene_pb2.Tensor.UINT32: "<u4"}
    return np.frombuffer(message.data, dtype=types[message.dtype]).reshape(tuple(message.shape))


def evaluate(fields, scene, points):
    """Returns value and gradient at points [n, 3] as an array [n, 4]. It streams chunks, so n may be of any size."""

    def requests():
        # The first message says what is asked; every message may carry points.
        yield field_service_pb2.EvaluateStreamRequest(scene=scene, quantity=field_service_pb2.VALUE_AND_GRADIENT)
        for start in range(0, len(points), CHUNK):
            yield field_service_pb2.EvaluateStreamRequest(points=tensor(points[start : start + CHUNK]))

    # The server answers a small chunk by one message and a large one by several, in order. Joined, they are the results
    # of all points.
    answers = [array(answer.result) for answer in fields.EvaluateStream(requests())]
    return np.concatenate(answers) if answers else np.empty((0, 4), "<f4")


def main():
    parser = argparse.ArgumentParser(description="Evaluate a scene at random points.")
    parser.add_argument("scene", nargs="?", help="a scene in JSON (default: two blended spheres)")
    parser.add_argument("--server", default="127.0.0.1:50051", help="HOST:PORT or unix:PATH")
    parser.add_argument("--points", type=int, default=1_000_000)
    arguments = parser.parse_args()

    text = open(arguments.scene, encoding="utf-8").read() if arguments.scene else EXAMPLE
    scene = scene_pb2.SceneRef(inline=json_format.Parse(text, scene_pb2.Scene()))
    points = np.random.default_rng(1).uniform(-2, 2, (arguments.points, 3))
    # gRPC limits received messages to 4 MiB by default, and the server's streams stay below that.
    with grpc.insecure_channel(arguments.server) as channel:
        fields = field_service_pb2_grpc.FieldServiceStub(channel)
        start = time.perf_counter()
        try:
            result = evaluate(fields, scene, points)
        except grpc.RpcError as error:
            raise SystemExit(f"{error.code().name}: {error.details()}")
        seconds = time.perf_counter() - start
    value, gradient = result[:, 0], result[:, 1:]
    inside = np.count_nonzero(value > 0.5)
    print(f"{len(points)} points in {seconds:.2f} s; {inside} inside, so the volume is about "
          f"{4**3 * inside / len(points):.3f}; largest gradient {np.linalg.norm(gradient, axis=1).max():.3f}")


if __name__ == "__main__":
    main()
