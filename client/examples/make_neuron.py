#!/usr/bin/env python3
"""Grows the example neuron: make_neuron.py > neuron.swc

A pyramidal cell in micrometres: a soma, a long apical dendrite with oblique branches and a tuft, basal dendrites and
an axon with collaterals. Radii follow Rall's rule at forks (r^1.5 is shared) and taper along branches; directions
wander. Nothing but the standard library; the same seed gives the same neuron.
"""

import math
import random

SOMA, AXON, BASAL, APICAL = 1, 2, 3, 4
random.seed(11)
samples = []  # (type, x, y, z, radius, parent), ids from 1


def add(kind, position, radius, parent):
    samples.append((kind, *position, radius, parent))
    return len(samples)


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def wander(direction, amount, pull=(0, 0, 0)):
    # Directions vary less along z, so that the cell is flatter along z than it is wide, which suits pictures.
    noise = (random.gauss(0, amount), random.gauss(0, amount), random.gauss(0, 0.6 * amount))
    return unit(tuple(d + n + p for d, n, p in zip(direction, noise, pull)))


def turn(direction, angle):
    """Returns a direction at this angle to the given one. The side is random, but prefers the x-y plane."""
    side = unit((random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 0.45)))
    along = sum(a * b for a, b in zip(side, direction))
    side = unit(tuple(s - along * d for s, d in zip(side, direction)))
    return unit(tuple(math.cos(angle) * d + math.sin(angle) * s for d, s in zip(direction, side)))


def grow(kind, parent, position, direction, radius, steps, step, taper, noise, pull=(0, 0, 0)):
    """Adds an unbranched stretch; returns its samples as (id, position, direction, radius)."""
    stretch = []
    for _ in range(steps):
        direction = wander(direction, noise, pull)
        position = tuple(p + step * d for p, d in zip(position, direction))
        radius *= taper
        parent = add(kind, position, radius, parent)
        stretch.append((parent, position, direction, radius))
    return stretch


def fork(kind, end, depth, steps, step, noise, pull=(0, 0, 0)):
    """Adds two branches at the end of a stretch, and repeats that at their ends, `depth` times in all."""
    waiting = [(end, depth, steps)]
    while waiting:
        (parent, position, direction, radius), left, count = waiting.pop()
        if left == 0:
            continue
        share = random.uniform(0.42, 0.58)
        for part, sign in ((share, 1), (1 - share, -1)):
            branch = turn(direction, math.radians(random.uniform(22, 42)))
            if sign < 0:  # mirrored, away from the sister branch
                branch = unit(tuple(2 * d - b for d, b in zip(direction, branch)))
            stretch = grow(kind, parent, position, branch, max(0.7, radius * part ** (2 / 3)),
                           max(3, count + random.randint(-2, 2)), step, 0.975, noise, pull)
            waiting.append((stretch[-1], left - 1, int(count * 0.85)))


soma = (0.0, 0.0, 0.0)
root = add(SOMA, soma, 11.5, -1)

trunk = grow(APICAL, root, (0, 9, 0), (0.06, 1, 0), 4.2, 20, 6.5, 0.982, 0.08, (0, 0.06, 0))
for at in (3, 6, 9, 12, 15):
    parent, position, direction, radius = trunk[at]
    side = grow(APICAL, parent, position, turn(direction, math.radians(random.uniform(55, 75))), 0.6 * radius,
                10, 6.5, 0.975, 0.12, (0, 0.05, 0))
    if at < 14:
        fork(APICAL, side[-1], 1, 8, 6, 0.15)
fork(APICAL, trunk[-1], 3, 8, 6.5, 0.14, (0, 0.02, 0))

for i in range(6):
    angle = math.radians(195 + 30 * i + random.uniform(-8, 8))
    out = unit((math.cos(angle), 0.75 * math.sin(angle), random.uniform(-0.6, 0.6)))
    start = tuple(8.5 * c for c in out)
    stem = grow(BASAL, root, start, out, 2.6, 7, 6.5, 0.965, 0.12, (0, -0.02, 0))
    fork(BASAL, stem[-1], 2, 9, 6.5, 0.14, (0, -0.01, 0))

axon = grow(AXON, root, (2, -9, 0), (0.25, -1, 0.1), 1.7, 24, 6.5, 0.988, 0.12, (0.02, -0.03, 0))
for at in (8, 14, 19):
    parent, position, direction, radius = axon[at]
    collateral = grow(AXON, parent, position, turn(direction, math.radians(75)), 0.7 * radius, 10, 6, 0.985, 0.15)
    fork(AXON, collateral[-1], 1, 6, 6, 0.16)

print("# A pyramidal cell that never lived: an example of the isofield project, MIT licence like the rest of it.")
print("# Made by make_neuron.py. Lengths in micrometres.")
print("# id type x y z radius parent    (types: 1 soma, 2 axon, 3 basal dendrite, 4 apical dendrite)")
for number, (kind, x, y, z, radius, parent) in enumerate(samples, 1):
    print(f"{number} {kind} {x:.2f} {y:.2f} {z:.2f} {radius:.3f} {parent}")
