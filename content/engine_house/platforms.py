"""What is stepped on: the pressure plate in the floor and the turntable."""
import math
import random
import numpy as np
from bodies import shade
from shapes import join, prism
from solids import bolt, from_above, turned_solid



# ---- pressure plate ----


def plate():
    """Radius 0.50, 0.04 m high; the stone's top is at 0.03, a ring and three dots of bronze stand 4 mm out of it."""
    rim = [
        (0.39, 0.0),
        (0.50, 0.0),
        (0.50, 0.030),
        (0.488, 0.040),
        (0.435, 0.040),
        (0.425, 0.032),
        (0.425, 0.0255),
        (0.39, 0.0255),
    ]
    stone = [(0.0, 0.0), (0.415, 0.0), (0.415, 0.026), (0.411, 0.030), (0.0, 0.030)]
    parts = [turned_solid(rim, 44, 'bronze'), turned_solid(stone, 44, 'flagstone')]
    return join(parts + emblem())


def emblem():
    ring = [(0.245, 0.005), (0.288, 0.005), (0.288, 0.031), (0.285, 0.034), (0.248, 0.034), (0.245, 0.031)]
    dot = [(0.0, 0.005), (0.052, 0.005), (0.052, 0.031), (0.049, 0.034), (0.0, 0.034)]
    parts = [turned_solid(ring, 40, 'bronze')]
    for i in range(3):
        a = math.radians(90 + 120 * i)
        parts.append(turned_solid(dot, 16, 'bronze').moved(0.125 * math.cos(a), 0.125 * math.sin(a), 0))
    return parts


# ---- turntable ----

RADIUS, HEIGHT = 0.95, 0.14
HUB, EDGE, BOARD = 0.190, 0.872, 0.147  # radii that the boards lie between, width of a board


def turntable():
    """Oak boards between an iron hub and a bolted iron rim, flush on top; a drum under them stands on the floor."""
    rim = [(0.88, 0.03), (0.94, 0.03), (0.94, 0.13), (0.93, 0.14), (0.886, 0.14), (0.88, 0.134)]
    drum = [(0.0, 0.0), (0.84, 0.0), (0.84, 0.035), (0.90, 0.035), (0.90, 0.118), (0.0, 0.118)]
    hub = [(0.0, 0.05), (0.182, 0.05), (0.182, 0.134), (0.176, 0.14), (0.0, 0.14)]
    parts = [turned_solid(rim, 56, 'iron'), turned_solid(drum, 40, 'iron'), turned_solid(hub, 28, 'iron')]
    for i in range(16):
        parts.append(bolt(0.017, 0.010).turned('y', 90).moved(RADIUS - 0.010, 0, 0.085).turned('z', 22.5 * i))
    return join(parts + boards())


def boards():
    """Six rows on either side of y = 0; a row's mirror image is of other wood."""
    rng, outlines = random.Random(5), []
    for row in range(math.ceil(EDGE / BOARD)):
        outlines += board_outlines(row * BOARD + 0.003, min((row + 1) * BOARD - 0.003, EDGE - 0.01))
    outlines += [[(x, -y) for x, y in outline] for outline in outlines]
    return [board(outline, rng) for outline in outlines]


def board_outlines(lo, hi):
    """Between y = lo and hi within the rim: one piece, with a bite for the hub, or two where the hub parts it."""
    at = lambda radius, y: math.sqrt(max(0.0, radius * radius - y * y))
    right = [(at(EDGE, y), y) for y in np.linspace(lo, hi, 4)]
    whole = right + [(-x, y) for x, y in right[::-1]]
    if lo > HUB:
        return [whole]
    if hi > HUB:
        half = math.acos(lo / HUB)
        return [whole + [(HUB * math.sin(a), HUB * math.cos(a)) for a in np.linspace(-half, half, 9)]]
    piece = right + [(at(HUB, y), y) for y in np.linspace(hi, lo, 4)]
    return [piece, [(-x, y) for x, y in piece]]


def board(outline, rng):
    out = prism(outline, 0.10, HEIGHT, 'wood', shade(rng, 0.85), axis='z')
    shift = rng.random(), rng.random()
    out = from_above(out)
    out.uvs = [[(a + shift[0], b + shift[1]) for a, b in uv] for uv in out.uvs]
    return out
