#!/usr/bin/env python3
"""Evaluates a sphere at random points through memory shared with isofieldd.

It uses nothing of isofield but its .proto files. Generate the Python code as eval_points.py says. Then, with isofieldd
--listen unix:PATH --shared-memory running:

    PYTHONPATH=generated client/examples/python/eval_shared.py --server unix:PATH [--points N]
"""

import argparse
import fcntl
import mmap
import os
import socket
import time

import grpc
import numpy as np
from isofield.v1 import field_service_pb2, field_service_pb2_grpc, info_service_pb2, info_service_pb2_grpc
from isofield.v1 import scene_pb2, shared_memory_pb2


class Region:
    """Memory shared with the server for as long as `connection` is open (shared_memory.proto)."""

    def __init__(self, path, size):
        descriptor = os.memfd_create("points", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        os.ftruncate(descriptor, size)
        fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW)
        self.memory = mmap.mmap(descriptor, size)
        self.connection = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.connection.connect(path)
        socket.send_fds(self.connection, [b"\x01"], [descriptor])
        os.close(descriptor)
        answer = shared_memory_pb2.OpenRegionResponse.FromString(self.connection.recv(4096))
        if not answer.region:
            raise SystemExit(answer.message)
        self.name = answer.region

    def array(self, offset, shape):
        """Returns a float32 array that begins at `offset` (bytes) of the memory, and the message that names it."""
        numbers = np.frombuffer(self.memory, "<f4", shape[0] * shape[1], offset).reshape(shape)
        return numbers, scene_pb2.SharedTensor(
            region=self.name, offset=offset, dtype=scene_pb2.Tensor.FLOAT32, shape=shape)


def main():
    parser = argparse.ArgumentParser(description="Evaluate a sphere at random points through shared memory.")
    parser.add_argument("--server", required=True, help="unix:PATH")
    parser.add_argument("--points", type=int, default=1_000_000, help="as many as one message may have")
    arguments = parser.parse_args()

    sphere = scene_pb2.Node(sphere=scene_pb2.Sphere(radius=1, range=0.5))
    scene = scene_pb2.SceneRef(inline=scene_pb2.Scene(nodes=[sphere]))
    with grpc.insecure_channel(arguments.server) as channel:
        info = info_service_pb2_grpc.InfoServiceStub(channel).GetInfo(info_service_pb2.GetInfoRequest())
        if not info.shared_memory_socket:
            raise SystemExit("the server shares no memory: start isofieldd with --shared-memory")
        results_at = -(-12 * arguments.points // 16) * 16
        region = Region(info.shared_memory_socket, results_at + 16 * arguments.points)
        points, shared_points = region.array(0, (arguments.points, 3))
        results, shared_result = region.array(results_at, (arguments.points, 4))
        points[:] = np.random.default_rng(1).uniform(-2, 2, points.shape)
        request = field_service_pb2.EvaluateRequest(
            scene=scene, quantity=field_service_pb2.VALUE_AND_GRADIENT, shared_points=shared_points,
            shared_result=shared_result)
        fields = field_service_pb2_grpc.FieldServiceStub(channel)
        start = time.perf_counter()
        try:
            fields.Evaluate(request)
        except grpc.RpcError as error:
            raise SystemExit(f"{error.code().name}: {error.details()}")
        seconds = time.perf_counter() - start
    inside = np.count_nonzero(results[:, 0] > 0.5)
    print(f"{len(points)} points in {seconds:.3f} s; {inside} inside, so the volume is about "
          f"{4**3 * inside / len(points):.3f}")


if __name__ == "__main__":
    main()
