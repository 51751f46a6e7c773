#!/usr/bin/env python3
"""Follows the mesh of a scene while a sphere moves, with nothing of isofield but its .proto files.

Generate the Python code as eval_points.py says. Then, with isofieldd running:

    PYTHONPATH=generated client/examples/python/track_mesh.py [--server ADDR] [--edits N] [--spheres N]
"""

import argparse
import queue

import grpc
import numpy as np
from isofield.v1 import mesh_service_pb2, mesh_service_pb2_grpc, scene_pb2, scene_service_pb2, scene_service_pb2_grpc

NAME = "track_mesh-example"


def array(message):
    """Returns the numbers of a Tensor message as an array."""
    types = {scene_pb2.Tensor.FLOAT32: "<f4", scene_pb2.Tensor.UINT32: "<u4"}
    return np.frombuffer(message.data, dtype=types[message.dtype]).reshape(tuple(message.shape))


def random_scene(spheres):
    """Returns a scene of blended spheres in a cube, and their centres."""
    scene = scene_pb2.Scene()
    centers = np.random.default_rng(1).uniform(-1, 1, (spheres, 3))
    for center in centers:
        scene.nodes.add().sphere.CopyFrom(scene_pb2.Sphere(center=center, radius=0.15, range=0.15))
    scene.nodes.add().gradient.children.extend(f"#{i}" for i in range(spheres))
    return scene, centers


class Mesh:
    """Keeps a mesh as bricks: `bricks` maps a brick's place (x, y, z) to its positions and corners."""

    def __init__(self):
        self.bricks = {}

    def apply(self, update):
        """Brings the mesh up to date; returns how many bricks came, and how many are empty now."""
        if update.is_whole:
            self.bricks.clear()
        removed = array(update.removed) if update.HasField("removed") else []
        for place in removed:
            del self.bricks[tuple(place)]
        if not update.HasField("bricks"):
            return 0, len(removed)
        table, positions, corners = (array(getattr(update.bricks, n)) for n in ("bricks", "positions", "corners"))
        vertex = triangle = 0
        for x, y, z, vertices, triangles in table.tolist():
            self.bricks[x, y, z] = positions[vertex : vertex + vertices], corners[triangle : triangle + triangles]
            vertex, triangle = vertex + vertices, triangle + triangles
        return len(table), len(removed)

    @staticmethod
    def order(place):
        """Returns the key that orders bricks when they are joined: floor(z / 8), then the Morton code."""
        code = sum((place[axis] >> bit & 1) << 3 * bit + axis for bit in range(21) for axis in range(3))
        return place[2] // 8, code

    def join(self):
        """Returns positions [n, 3] and triangles [m, 3], whose corners are numbers of vertices."""
        places = sorted(self.bricks, key=self.order)
        first, vertices = {}, 0
        for place in places:
            first[place] = vertices
            vertices += len(self.bricks[place][0])
        positions, triangles = [np.empty((0, 3), "<f4")], [np.empty((0, 3), "<u4")]
        for x, y, z in places:
            points, corners = self.bricks[x, y, z]
            # Bits 24 to 26 of a corner name one of these 8 bricks: the one that has its vertex.
            starts = [first.get((x - (i & 1), y - (i >> 1 & 1), z - (i >> 2)), 0) for i in range(8)]
            positions.append(points)
            triangles.append(np.array(starts, "<u4")[corners >> 24] + (corners & 0xFFFFFF))
        return np.concatenate(positions), np.concatenate(triangles)


def follow(answers, mesh):
    """Reads one answer; returns how many bricks came, how many are empty now, and the summary."""
    came = gone = 0
    for answer in answers:
        put, removed = mesh.apply(answer.update)
        came, gone = came + put, gone + removed
        if answer.update.is_last:
            return came, gone, answer.update.summary
    raise SystemExit("the server ended the stream")


def main():
    parser = argparse.ArgumentParser(description="Follow the mesh of a scene while a sphere moves.")
    parser.add_argument("--server", default="127.0.0.1:50051", help="HOST:PORT or unix:PATH")
    parser.add_argument("--edits", type=int, default=8)
    parser.add_argument("--spheres", type=int, default=200)
    arguments = parser.parse_args()

    with grpc.insecure_channel(arguments.server) as channel:
        catalog = scene_service_pb2_grpc.SceneServiceStub(channel)
        scene, centers = random_scene(arguments.spheres)
        # This queue holds messages to the server. Each is sent once the answer to the one before it is read.
        requests = queue.Queue()
        try:
            catalog.PutScene(scene_service_pb2.PutSceneRequest(name=NAME, scene=scene))
            begin = mesh_service_pb2.MeshRequest(scene=scene_pb2.SceneRef(name=NAME), cell_size=0.03)
            requests.put(mesh_service_pb2.TrackMeshRequest(begin=begin))
            answers = mesh_service_pb2_grpc.MeshServiceStub(channel).TrackMesh(iter(requests.get, None))
            mesh = Mesh()
            came, _, summary = follow(answers, mesh)
            print(f"{came} bricks of {summary.triangles} triangles in {summary.seconds:.3f} s")
            for i in range(arguments.edits):
                x = centers[0][0] + 0.2 * np.sin(2 * np.pi * (i + 1) / arguments.edits)
                move = scene_service_pb2.ParameterEdit(node="#0", field="center.x", values=[x])
                edit = scene_service_pb2.EditParametersRequest(edits=[move])
                requests.put(mesh_service_pb2.TrackMeshRequest(edit=edit))
                came, gone, summary = follow(answers, mesh)
                print(f"x = {x:+.3f}: {came} bricks changed and {gone} removed of {len(mesh.bricks)} "
                      f"in {summary.seconds:.3f} s")
            positions, triangles = mesh.join()
            assert (len(positions), len(triangles)) == (summary.vertices, summary.triangles)
            assert triangles.max(initial=0) < max(len(positions), 1)
            print(f"{len(positions)} vertices, {len(triangles)} triangles")
            requests.put(None)  # ends the stream of requests
            catalog.DeleteScene(scene_service_pb2.DeleteSceneRequest(name=NAME))
        except grpc.RpcError as error:
            raise SystemExit(f"{error.code().name}: {error.details()}")
        finally:
            requests.put(None)


if __name__ == "__main__":
    main()
