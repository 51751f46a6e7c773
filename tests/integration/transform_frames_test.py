"""Tests blends under transforms that change angles: a transform of f must yield f(T^-1 p).

A second implementation in NumPy, in double precision and with bisection throughout, evaluates trees node by node, each
in its own frame, and is compared with the daemon. It shares no code and no derivation with the project: the smooth
silhouette is solved in the additive form h(x1) + h(x2) = 1, and all partial derivatives are differences.

Usage: transform_frames_test.py ISOFIELDD PROTOC PROTO_FOLDER
"""

import sys

import numpy as np

from served import array, served

R0 = np.sqrt(1 - 2 ** (-1 / 3))
NULL = 1e-3  # (|gradient| length)^2 below which a gradient begins to count as null
OPENINGS = {  # alpha0, alpha1, alpha2, theta0, theta1, theta2, w0, w1 of [G], Table I
    "CAMEL": (0, np.pi / 2, np.pi, np.pi / 4, 0, np.pi / 4, 1, 1),
    "ORGANIC": (0, np.pi / 3, 3 * np.pi / 4, np.pi / 6, 0, np.pi / 4, 3, 1),
}
POINTS, GRADIENTS = 300, 60


def bisect(function, low, high):
    """Returns the root of a function that falls from `low` to `high`, which are arrays."""
    for _ in range(40):
        middle = 0.5 * (low + high)
        is_low = function(middle) > 0
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    return 0.5 * (low + high)


# The gradient blend, [G] eqs. 15 to 24 ------------------------------------------------------------------------------


def kappa(x):
    x = np.clip(x, 1e-12, 1 - 1e-15)
    with np.errstate(over="ignore", under="ignore", divide="ignore"):
        return -np.expm1(1 + 1 / np.expm1(1 - 1 / x))


def opening(name, alpha):
    a0, a1, a2, t0, t1, t2, w0, w1 = OPENINGS[name]
    first = kappa((alpha - a1) / (a0 - a1)) ** w0 * (t0 - t1) + t1
    second = kappa((alpha - a1) / (a2 - a1)) ** w1 * (t2 - t1) + t1
    return np.where(alpha <= a0, t0, np.where(alpha <= a1, first, np.where(alpha < a2, second, t2)))


def nu(x):
    return np.expm1(np.expm1(np.e * (1 - x)))


def h(x):
    return np.where(x <= 0, 0, np.where(x >= 1, 1, 1 / (1 + nu(np.clip(x, 0, 1)))))


def phi(x):
    def off(y):  # x - phi^-1(y)
        with np.errstate(divide="ignore", over="ignore"):
            return x - y - np.log1p(np.log1p(1 / nu(np.clip(y, 1e-300, 1 - 1e-16)))) / np.e
    return np.where(x <= 0, 0, bisect(off, np.zeros_like(x), np.ones_like(x)))


def boundary(f, t):
    lam = np.where(f <= t / 2, f, (1 - t) / 4 * phi(2 * (2 * f - t) / np.maximum(1 - t, 1e-12)) + t / 2)
    return np.where(f >= 0.5, t / 2, t / 2 * (4 * lam / (1 + t)) ** 2)


def smooth_blend(f1, f2, t):
    """Returns g(f1, f2) at t = tan(theta)."""
    most, least = np.maximum(f1, f2), np.minimum(f1, f2)

    def above(c):
        k = boundary(c, t)
        reach = np.maximum(c - k, 1e-300)
        return h((most - k) / reach) + h((least - k) / reach) - 1

    k = boundary(most, t)
    g = bisect(above, most, 1.25 * most + 1e-12)
    return np.where((least <= k) | (least <= 0), most, g)


def differenced(g, f1, f2, step=1e-4):
    """Returns an operator's value and partial derivatives."""
    return (g(f1, f2), (g(f1 + step, f2) - g(f1 - step, f2)) / (2 * step),
            (g(f1, f2 + step) - g(f1, f2 - step)) / (2 * step))


def dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def gradient_blend(preset, a, b, length):
    (f1, d1), (f2, d2) = a, b
    alpha = np.arctan2(np.linalg.norm(np.cross(d1, d2), axis=1), dot(d1, d2))
    least = min(OPENINGS[preset][3:6])

    def presence(d):
        s = np.clip(dot(d, d) * length ** 2 / NULL, 0, 1)
        return s * s * (3 - 2 * s)

    t = np.tan(least) + (np.tan(opening(preset, alpha)) - np.tan(least)) * presence(d1) * presence(d2)
    g, g1, g2 = differenced(lambda x, y: smooth_blend(x, y, t), f1, f2)
    zero1, zero2 = f1 <= 0, f2 <= 0
    g1, g2 = np.where(zero2, 1, np.where(zero1, 0, g1)), np.where(zero1, 1, np.where(zero2, 0, g2))
    return g, g1[:, None] * d1 + g2[:, None] * d2


# Ranges that follow an angle: [G] eq. 4 with Rockwood's ranges, [H] eqs. 4 and 5 with section 5 ---------------------


def cosine_and_ratio(d1, d2):
    n1, n2 = np.linalg.norm(d1, axis=1), np.linalg.norm(d2, axis=1)
    is_null = np.minimum(n1, n2) <= 1e-12  # beyond all ranges
    n1, n2 = np.where(is_null, 1, n1), np.where(is_null, 1, n2)
    return np.where(is_null, 0, np.clip(dot(d1, d2) / (n1 * n2), -1, 1)), np.clip(n1 / n2, 1 / 8, 8)


def eliminated(m1, m2, cosine, ratio):
    aligned = np.maximum(cosine, 0)
    first_leads = m1 > m2 * ratio
    return (np.where(first_leads, m1, m1 + (m2 * ratio - m1) * aligned),
            np.where(first_leads, m2 + (m1 / ratio - m2) * aligned, m2))


def superelliptic(x, r, t):
    brackets = [np.maximum(0, 1 - xi / ri) ** t for xi, ri in zip(x, r)]
    return 1 - sum(brackets)


def bt2(x, r, m, p):
    (x1, x2), (r1, r2), (m1, m2) = x, r, m
    least = np.minimum(x1 / m1, x2 / m2)
    region = (m2 * x1 - m1 * (x2 - r2) > 0) & (m2 * (x1 - r1) - m1 * x2 < 0)
    low = (r1 * x2 + r2 * x1 - r1 * r2) / (r1 * m2 + r2 * m1)

    def conic(level):  # [H]: the quadric at the fields less the level, which falls through 0 in the bracket
        y1, y2 = x1 - m1 * level, x2 - m2 * level
        return (r1 * y2 + r2 * y1 - r1 * r2) ** 2 + 2 * (p - r1 * r2) * y1 * y2

    sign = np.sign(conic(low))
    return np.where(region, bisect(lambda level: sign * conic(level), low, least), least)


def btk(x, r, m, power):
    low = np.minimum(*[(xi - ri) / mi for xi, ri, mi in zip(x, r, m)])
    high = np.minimum(*[xi / mi for xi, mi in zip(x, m)])
    return bisect(lambda level: 1 - sum(np.maximum(0, (ri - xi + mi * level) / ri) ** power
                                        for xi, ri, mi in zip(x, r, m)), low, high)


def ranged(kind, parameters, a, b):
    (x1, d1), (x2, d2) = a, b
    cosine, ratio = cosine_and_ratio(d1, d2)
    r = [ri * (1 - cosine + parameters["omega"]) for ri in parameters["r"]]
    m = eliminated(*parameters["m"], cosine, ratio)

    def value(f1, f2):
        if kind == "superelliptic":
            return superelliptic((f1, f2), r, parameters["t"])
        if kind == "bt2":
            return bt2((f1, f2), r, m, parameters["p"] * r[0] * r[1] / (parameters["r"][0] * parameters["r"][1]))
        return btk((f1, f2), r, m, parameters["power"])

    f, g1, g2 = differenced(value, x1, x2)
    return f, g1[:, None] * d1 + g2[:, None] * d2


# Trees: each node is evaluated in its own frame. A node is (message, evaluate), and evaluate(p) yields the field, its
# steering direction and the largest range below. ------------------------------------------------------------------


def softened(d, direction, reach):
    r = np.clip(R0 + (1 - R0) * d / reach, 0, 1)
    slope = -6 * r * (1 - r * r) ** 2 * (1 - R0) / reach
    return (1 - r * r) ** 3, slope[:, None] * direction


def primitive(nodes, point_of, radius, reach, message):
    nodes.append(message)

    def evaluate(p):
        v = p - point_of(p)
        distance = np.linalg.norm(v, axis=1)
        direction = v / distance[:, None]
        if reach is None:
            return distance - radius, direction, 0
        return *softened(distance - radius, direction, reach), reach

    return f"#{len(nodes) - 1}", evaluate


def sphere(nodes, random, is_signed):
    center, radius = random.uniform(-0.6, 0.6, 3), random.uniform(0.3, 0.6)
    reach = None if is_signed else random.uniform(0.4, 1.0)
    message = {"center": center.tolist(), "radius": radius, **({"law": "SIGNED"} if is_signed else {"range": reach})}
    return primitive(nodes, lambda p: center, radius, reach, {"sphere": message})


def segment(nodes, random, is_signed):
    a, b, radius = random.uniform(-0.8, 0.8, 3), random.uniform(-0.8, 0.8, 3), random.uniform(0.2, 0.4)
    reach = None if is_signed else random.uniform(0.4, 1.0)
    message = {"a": a.tolist(), "b": b.tolist(), "radius_a": radius, "radius_b": radius,
               **({"law": "SIGNED"} if is_signed else {"range": reach})}

    def nearest(p):
        t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        return a + t[:, None] * (b - a)

    return primitive(nodes, nearest, radius, reach, {"segment": message})


def placed(nodes, child, matrix, offset):
    reference, inner = child
    nodes.append({"transform": {"child": reference, "matrix": np.hstack([matrix, offset[:, None]]).ravel().tolist()}})
    inverse = np.linalg.inv(matrix)

    def evaluate(p):
        f, d, length = inner((p - offset) @ inverse.T)
        return f, d @ inverse, length * np.linalg.svd(matrix, compute_uv=False)[-1]

    return f"#{len(nodes) - 1}", evaluate


def joined(nodes, first, second, kind, parameters):
    children = [first[0], second[0]]
    if kind in OPENINGS:
        nodes.append({"gradient": {"children": children, "opening": {"preset": kind}}})
    elif kind == "superelliptic":
        nodes.append({"superelliptic": {"children": children, "exponent": parameters["t"], "ranges": parameters["r"],
                                        "by_angle": True, "omega": parameters["omega"]}})
    elif kind == "bt2":
        (r1, r2), (m1, m2) = parameters["r"], parameters["m"]
        nodes.append({"bt2": {"children": children, "r1": r1, "r2": r2, "m1": m1, "m2": m2, "p": parameters["p"],
                              "eliminate_bulge": True, "omega": parameters["omega"]}})
    else:
        nodes.append({"btk": {"children": children, "ranges": parameters["r"], "weights": parameters["m"],
                              "powers": [parameters["power"]], "eliminate_bulge": True,
                              "omega": parameters["omega"]}})

    def evaluate(p):
        f1, d1, length1 = first[1](p)
        f2, d2, length2 = second[1](p)
        length = max(length1, length2)
        if kind in OPENINGS:
            return *gradient_blend(kind, (f1, d1), (f2, d2), length), length
        return *ranged(kind, parameters, (f1, d1), (f2, d2)), length

    return f"#{len(nodes) - 1}", evaluate


def map_of(random, condition):
    """Returns a matrix of this condition number and an offset. The map scales, shears, turns, sometimes mirrors."""
    turns = [np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in range(2)]
    stretch = np.array([1, condition ** random.uniform(0, 1), condition]) / np.sqrt(condition)
    return turns[0] @ np.diag(stretch) @ turns[1], random.uniform(-0.3, 0.3, 3)


def parameters_of(random):
    r = random.uniform(0.3, 0.9, 2)
    return {"r": r.tolist(), "m": random.uniform(0.5, 2, 2).tolist(), "t": random.uniform(1.5, 4),
            "power": random.uniform(1.5, 4), "p": random.uniform(-1, 0.5) * r[0] * r[1],
            "omega": random.uniform(0.01, 0.1)}


def scene(kind, condition, depth, random):
    """Returns a tree of `depth` operators of the kind, each below a map of this condition number."""
    is_signed = kind not in OPENINGS
    nodes = []
    tree = sphere(nodes, random, is_signed)
    for _ in range(depth):
        tree = joined(nodes, tree, segment(nodes, random, is_signed), kind, parameters_of(random))
        tree = placed(nodes, tree, *map_of(random, condition ** (1 / depth)))
    return {"nodes": nodes, "root": tree[0]}, tree[1]


def ask(channel, message, points):
    from google.protobuf import json_format
    from isofield.v1 import field_service_pb2 as fields
    from isofield.v1 import field_service_pb2_grpc as services
    from isofield.v1 import scene_pb2

    request = fields.EvaluateRequest(
        scene=scene_pb2.SceneRef(inline=json_format.ParseDict(message, scene_pb2.Scene())),
        quantity=fields.VALUE_AND_GRADIENT,
        points=scene_pb2.Tensor(dtype=scene_pb2.Tensor.FLOAT32, shape=points.shape, data=points.tobytes()))
    return array(services.FieldServiceStub(channel).Evaluate(request).result)


def check_fields(channel):
    random = np.random.default_rng(7)
    for kind in (*OPENINGS, "superelliptic", "bt2", "btk"):
        for condition in (1, 3, 10, 100):
            for depth in (1, 2):
                message, evaluate = scene(kind, condition, depth, random)
                points = random.uniform(-2, 2, (POINTS, 3)).astype("<f4")
                p = points.astype(float)
                result = ask(channel, message, points)
                value = evaluate(p)[0]
                step = 1e-5
                some = p[:GRADIENTS]
                gradient = np.stack([(evaluate(some + step * e)[0] - evaluate(some - step * e)[0]) / (2 * step)
                                     for e in np.eye(3)], axis=1)
                # A super-elliptic blend is a high power deep inside, and a nested one multiplies the rounding below it.
                off = np.where(np.abs(value) > 4, 0, np.abs(result[:, 0] - value))
                # Compact fields are within 2e-6 up to a condition number of 10; else the rounding of the point counts, too.
                slope = np.linalg.norm(result[:, 1:], axis=1)
                rounding = slope * np.finfo("<f4").eps * np.linalg.norm(p, axis=1) * condition
                allowed = 2e-6 * np.maximum(np.abs(value), 1) + (0 if kind in OPENINGS and condition <= 10 else rounding)
                turned = np.linalg.norm(result[:GRADIENTS, 1:] - gradient, axis=1) / (slope.max() + 1e-9)
                smooth = np.quantile(turned, 0.97)  # beside folds and clamps differences say nothing
                print(f"{kind:13} condition {condition:3} depth {depth}: values within {off.max():.2g}, "
                      f"gradients within {smooth:.2g}")
                assert (off <= allowed).all(), (kind, condition, depth, off.max(), points[(off / allowed).argmax()])
                assert smooth <= 1e-4 * condition, (kind, condition, depth, smooth)


def check_pick(channel):
    """Checks that a picked angle is the one that the placed scene blends by: both are measured in the node's frame."""
    from google.protobuf import json_format
    from isofield.v1 import operator_service_pb2 as operators
    from isofield.v1 import operator_service_pb2_grpc as services
    from isofield.v1 import scene_pb2

    nodes = [{"segment": {"a": [-1, 0, 0], "b": [1, 0, 0], "radius_a": 0.3, "radius_b": 0.3, "range": 0.5}},
             {"segment": {"a": [0, 0, 0], "b": [1, 1, 0], "radius_a": 0.3, "radius_b": 0.3, "range": 0.5}},
             {"name": "both", "gradient": {"children": ["#0", "#1"], "opening": {"preset": "CAMEL"}}},
             {"transform": {"child": "both", "scale": [3, 1, 1]}}]
    point = np.array([-0.1, 0.32, 0.05])
    picked = services.OperatorServiceStub(channel).PickOpening(operators.PickOpeningRequest(
        scene=scene_pb2.SceneRef(inline=json_format.ParseDict({"nodes": nodes, "root": "#3"}, scene_pb2.Scene())),
        node="both", point=point))
    t = np.tan(opening("CAMEL", np.radians(picked.alpha)))
    expected = smooth_blend(np.array([picked.f1]), np.array([picked.f2]), t)[0]
    at = (point * [3, 1, 1]).astype("<f4")[None]
    found = ask(channel, {"nodes": nodes, "root": "#3"}, at)[0, 0]
    print(f"picked alpha = {picked.alpha:.2f} degrees: the placed blend is {found:.6f}, expected {expected:.6f}")
    assert abs(found - expected) <= 2e-6


def main():
    with served(*sys.argv[1:]) as channel:
        check_fields(channel)
        check_pick(channel)


if __name__ == "__main__":
    main()
