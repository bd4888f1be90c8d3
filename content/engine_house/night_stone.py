"""The night stone: an eight-sided crystal on a low foot of stone, standing on z = 0."""
import math
from shapes import join, make, rings
from solids import from_above

SIDES = 8
SHAFT = [(0.078, 0.055), (0.094, 0.13), (0.060, 0.345), (0.020, 0.42)]  # radius, z
FOOT = [(0.0, 0.0), (0.150, 0.0), (0.150, 0.034), (0.138, 0.046), (0.108, 0.050), (0.100, 0.068), (0.0, 0.068)]


def night_stone():
    return join([foot(), crystal()])


def octagon(radius, z):
    """Points whose flat sides look along x and y; `radius` is to the middle of a side."""
    r = radius / math.cos(math.pi / SIDES)
    angles = [2 * math.pi * (i + 0.5) / SIDES for i in range(SIDES)]
    return [(r * math.cos(a), r * math.sin(a), z) for a in angles]


def foot():
    loops = [octagon(r, z) if r > 0 else [(0, 0, z)] * SIDES for r, z in FOOT]
    return from_above(rings(loops, 'flagstone'))


def crystal():
    """Every facet shows the whole width of the picture `night`; v runs from foot to tip."""
    points = [p for r, z in SHAFT for p in octagon(r, z)]
    low, high = SHAFT[0][1], SHAFT[-1][1]
    faces, uvs = [], []
    for ring in range(len(SHAFT) - 1):
        v0, v1 = ((SHAFT[ring + k][1] - low) / (high - low) for k in (0, 1))
        for i in range(SIDES):
            k = (i + 1) % SIDES
            a, b = ring * SIDES, (ring + 1) * SIDES
            faces.append((a + i, a + k, b + k, b + i))
            uvs.append([(0.0, v0), (1.0, v0), (1.0, v1), (0.0, v1)])
    last = (len(SHAFT) - 1) * SIDES
    faces += [tuple(range(SIDES))[::-1], tuple(range(last, last + SIDES))]
    uvs += [[(0.02, 0.02)] * SIDES, [(0.5, 0.98)] * SIDES]
    return make(points, faces, 'night', uvs=uvs)
