"""Evaluates and meshes a sphere from Python with nothing but the .proto files, against NumPy's own formulas. No option
of the channel is set: messages larger than gRPC's default of 4 MiB would not be received.

Usage: python_client_test.py ISOFIELDD PROTOC PROTO_FOLDER
"""

import sys

import grpc
import numpy as np

from served import array, served

CENTER = np.array([0.25, -0.5, 0.125])
RADIUS, RANGE = 1.0, 0.5
R0 = np.sqrt(1 - 2 ** (-1 / 3))


def field(points):
    """Returns (1 - r^2)^3 with r = clamp(r0 + (1 - r0) d / range, 0, 1), and its gradient."""
    offset = points - CENTER
    distance = np.linalg.norm(offset, axis=1)
    r = np.clip(R0 + (1 - R0) * (distance - RADIUS) / RANGE, 0, 1)
    slope = np.where((r > 0) & (r < 1), -6 * r * (1 - r * r) ** 2 * (1 - R0) / RANGE, 0)
    return (1 - r * r) ** 3, slope[:, None] * offset / distance[:, None]


def check_evaluation(channel, reference):
    from isofield.v1 import field_service_pb2 as fields
    from isofield.v1 import field_service_pb2_grpc as services
    from isofield.v1 import scene_pb2

    points = np.random.default_rng(1).uniform(-2, 2, (20000, 3)).astype("<f4")
    tensor = scene_pb2.Tensor(dtype=scene_pb2.Tensor.FLOAT32, shape=points.shape, data=points.tobytes())
    request = fields.EvaluateRequest(scene=reference, quantity=fields.VALUE_AND_GRADIENT, points=tensor)
    result = array(services.FieldServiceStub(channel).Evaluate(request).result)
    value, gradient = field(points.astype(float))
    assert result.shape == (20000, 4), result.shape
    value_error = np.abs(result[:, 0] - value).max()
    gradient_error = np.linalg.norm(result[:, 1:] - gradient, axis=1).max() / np.linalg.norm(gradient, axis=1).max()
    print(f"20,000 points: errors {value_error:.2g} of values, {gradient_error:.2g} of gradients")
    assert value_error <= 2e-5 and gradient_error <= 1e-3

    tensor.data = tensor.data[:-1]
    try:
        services.FieldServiceStub(channel).Evaluate(
            fields.EvaluateRequest(scene=reference, points=tensor))
        raise AssertionError("a cut buffer was accepted")
    except grpc.RpcError as error:
        assert error.code() == grpc.StatusCode.INVALID_ARGUMENT and "239999 bytes" in error.details(), error


def check_mesh(channel, reference):
    from isofield.v1 import mesh_service_pb2 as meshes
    from isofield.v1 import mesh_service_pb2_grpc as services

    cell = 0.05
    summary, positions, normals, triangles = None, [], [], []
    for response in services.MeshServiceStub(channel).Mesh(meshes.MeshRequest(scene=reference, cell_size=cell)):
        if response.HasField("summary"):
            summary = response.summary
        if response.HasField("part"):
            for name, parts in ("positions", positions), ("normals", normals), ("triangles", triangles):
                if response.part.HasField(name):
                    parts.append(array(getattr(response.part, name)))
    positions, normals, triangles = map(np.concatenate, (positions, normals, triangles))
    assert (len(positions), len(triangles)) == (summary.vertices, summary.triangles)
    offset = positions.astype(float) - CENTER
    distance = np.linalg.norm(offset, axis=1)
    assert np.abs(distance - RADIUS).max() <= 0.01 * cell
    assert np.abs(normals - offset / distance[:, None]).max() <= 1e-3
    # The mesh is closed if every edge is there once in each direction. It faces outward if its volume is the ball's.
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    there, back = (np.sort(e[:, 0].astype(np.uint64) << np.uint64(32) | e[:, 1]) for e in (edges, edges[:, ::-1]))
    assert np.array_equal(there, back) and len(np.unique(there)) == len(there)
    a, b, c = (positions[triangles[:, i]].astype(float) for i in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    print(f"{len(positions)} vertices, {len(triangles)} triangles, volume {volume:.4f}")
    assert abs(volume - 4 / 3 * np.pi) < 0.02


def check_grids(channel, reference):
    """Checks grids of 4 MiB to 256 MiB of numbers: every part has a place, and together they are the whole."""
    from isofield.v1 import field_service_pb2 as fields
    from isofield.v1 import field_service_pb2_grpc as services

    for counts in (64, 64, 64), (128, 128, 128), (256, 256, 256), (1000, 1000, 2), (300_000, 2, 3):
        nx, ny, nz = counts
        origin, spacing = np.array([-1.5, -2.0, -1.6]), 3.5 / np.array(counts)
        request = fields.EvaluateGridRequest(scene=reference, quantity=fields.VALUE_AND_GRADIENT, origin=origin,
                                             spacing=spacing, counts=counts)
        grid = np.full((nz, ny, nx, 4), np.nan, "<f4")
        messages, largest = 0, 0
        for part in services.FieldServiceStub(channel).EvaluateGrid(request):
            messages, largest = messages + 1, max(largest, part.ByteSize())
            numbers = array(part.result)
            k, j, i = part.first_layer, part.first_row, part.first_column
            layers, rows, columns, _ = numbers.shape
            grid[k : k + layers, j : j + rows, i : i + columns] = numbers
        assert not np.isnan(grid).any(), "the parts leave a gap"
        sampled = np.random.default_rng(2).integers(0, counts, (20000, 3))
        value, gradient = field(origin + sampled * spacing)
        found = grid[sampled[:, 2], sampled[:, 1], sampled[:, 0]]
        assert np.abs(found[:, 0] - value).max() <= 2e-5
        assert np.linalg.norm(found[:, 1:] - gradient, axis=1).max() <= 1e-3 * np.linalg.norm(gradient, axis=1).max()
        print(f"grid of {nx} x {ny} x {nz}: {messages} messages of at most {largest} bytes")
        assert largest <= 4194304


def check_large_chunks(channel, reference):
    from isofield.v1 import field_service_pb2 as fields
    from isofield.v1 import field_service_pb2_grpc as services
    from isofield.v1 import scene_pb2

    points = np.random.default_rng(3).uniform(-2, 2, (2, 1_000_000, 3)).astype("<f4")

    def requests():
        yield fields.EvaluateStreamRequest(scene=reference, quantity=fields.VALUE_AND_GRADIENT)
        for chunk in points:
            yield fields.EvaluateStreamRequest(points=scene_pb2.Tensor(
                dtype=scene_pb2.Tensor.FLOAT32, shape=chunk.shape, data=chunk.tobytes()))

    answers = [array(answer.result) for answer in services.FieldServiceStub(channel).EvaluateStream(requests())]
    result = np.concatenate(answers)
    print(f"2 chunks of a million points: {len(answers)} answers")
    assert result.shape == (2_000_000, 4)
    assert np.abs(result[:, 0] - field(points.reshape(-1, 3).astype(float))[0]).max() <= 2e-5
    try:
        services.FieldServiceStub(channel).Evaluate(fields.EvaluateRequest(
            scene=reference, quantity=fields.VALUE_AND_GRADIENT, points=scene_pb2.Tensor(
                dtype=scene_pb2.Tensor.FLOAT32, shape=points[0].shape, data=points[0].tobytes())))
        raise AssertionError("an answer of 16 MB was sent")
    except grpc.RpcError as error:
        assert error.code() == grpc.StatusCode.RESOURCE_EXHAUSTED and "EvaluateStream" in error.details(), error


def check_large_mesh(channel, reference):
    from isofield.v1 import mesh_service_pb2 as meshes
    from isofield.v1 import mesh_service_pb2_grpc as services

    vertices = triangles = largest = 0
    for response in services.MeshServiceStub(channel).Mesh(meshes.MeshRequest(scene=reference, cell_size=0.004)):
        largest = max(largest, response.ByteSize())
        vertices += len(array(response.part.positions)) if response.part.HasField("positions") else 0
        triangles += len(array(response.part.triangles)) if response.part.HasField("triangles") else 0
        if response.HasField("summary"):
            summary = response.summary
    print(f"mesh of {triangles} triangles, messages of at most {largest} bytes")
    assert triangles > 1_000_000 and (vertices, triangles) == (summary.vertices, summary.triangles)


def check_numbers(channel, reference):
    from isofield.v1 import field_service_pb2 as fields
    from isofield.v1 import field_service_pb2_grpc as services
    from isofield.v1 import scene_pb2

    points = [*CENTER, CENTER[0] + RADIUS, CENTER[1], CENTER[2]]
    answer = services.FieldServiceStub(channel).Evaluate(fields.EvaluateRequest(
        scene=reference, points=scene_pb2.Tensor(numbers=points), answer_in_numbers=True))
    assert np.allclose(answer.result.numbers, [1, 0.5], atol=1e-6) and not answer.result.data, answer


def check_large_scene(catalog):
    from isofield.v1 import scene_pb2
    from isofield.v1 import scene_service_pb2 as scenes

    scene = scene_pb2.Scene()
    for i in range(20_000):
        scene.nodes.add(name=f"node {i}").sphere.CopyFrom(
            scene_pb2.Sphere(center=[i % 30, i // 30 % 30, i // 900], radius=0.1, range=0.1))
    scene.nodes.add().sum.children.extend(f"#{i}" for i in range(20_000))
    catalog.PutScene(scenes.PutSceneRequest(name="large", scene=scene))
    got = catalog.GetScene(scenes.GetSceneRequest(name="large"))
    parts = b"".join(part.data for part in catalog.GetSceneParts(scenes.GetSceneRequest(name="large")))
    print(f"scene of 20,001 nodes: {len(parts)} bytes")
    assert got.scene == scene and scene_pb2.Scene.FromString(parts) == scene
    catalog.DeleteScene(scenes.DeleteSceneRequest(name="large"))


def main():
    with served(*sys.argv[1:]) as channel:
        from isofield.v1 import scene_pb2
        from isofield.v1 import scene_service_pb2 as scenes
        from isofield.v1 import scene_service_pb2_grpc as services

        ball = scene_pb2.Node(name="ball", sphere=scene_pb2.Sphere(center=CENTER, radius=RADIUS, range=RANGE))
        catalog = services.SceneServiceStub(channel)
        catalog.PutScene(scenes.PutSceneRequest(name="ball", scene=scene_pb2.Scene(nodes=[ball])))
        reference = scene_pb2.SceneRef(name="ball")
        check_evaluation(channel, reference)
        check_mesh(channel, reference)
        check_numbers(channel, reference)
        check_grids(channel, reference)
        check_large_chunks(channel, reference)
        check_large_mesh(channel, reference)
        check_large_scene(catalog)


if __name__ == "__main__":
    main()
