"""Small things for the hand: the valve's hand wheel, a gear, the tool crate. All lie on z = 0 at the origin."""
import math
import numpy as np
import bodies
import machine
from shapes import box, circle, join, ring_prism, sweep, tube

RIM = 0.024  # radius of the section of the hand wheel's rim
DARK = (0.33, 0.30, 0.28)


def valve_wheel():
    """0.46 m across, 0.09 m high: a round rim that lies on the floor, five bent spokes up to the hub."""
    return join([rim()] + [spoke(72 * i) for i in range(5)] + hub())


def rim():
    frames = []
    for a in np.linspace(0, 2 * math.pi, 45)[:-1]:
        c, s = math.cos(a), math.sin(a)
        frames.append((((0.23 - RIM) * c, (0.23 - RIM) * s, RIM), (c, s, 0), (0, 0, 1)))
    return sweep(circle(RIM, 12, 0.0), frames, 'red', closed=True)


def spoke(degrees):
    way = [(0.03, 0.0, 0.056), (0.07, 0.008, 0.052), (0.11, 0.018, 0.042), (0.155, 0.020, 0.031), (0.20, 0.008, 0.024)]
    return tube(way, 0.0165, 10, 'red').turned('z', degrees)


def hub():
    """With a square bore for the stem, and a bare iron face."""
    around = [(x / max(abs(x), abs(y)), y / max(abs(x), abs(y))) for x, y in circle(1.0, 16, 0.0)]
    square = lambda half: [(half * x, half * y) for x, y in around]
    return [
        ring_prism(circle(0.058, 16, 0.0), square(0.018), 0.0, 0.078, 'red'),
        ring_prism(circle(0.050, 16, 0.0), square(0.016), 0.04, 0.09, 'iron'),
    ]


def gear_small():
    """0.40 m across its teeth, 0.10 m high at the hub, which is bushed in brass."""
    out = machine.gear(16, 0.182, 0.04, 0.038, 0.035)
    bush = ring_prism(circle(0.050, 20), circle(0.024, 20), -0.05, 0.05, 'brass')
    return join([out, bush]).moved(0, 0, 0.05)


def crate_tool():
    """The hall's crate about a dark filling: its boards alone are thinner than a voxel."""
    x, y, z = 0.40, 0.34, 0.30
    inside = 0.030
    filling = box((inside - x / 2, inside - y / 2, 0.012), (x / 2 - inside, y / 2 - inside, z - 0.012), 'wood', DARK)
    return join([bodies.crate(x, y, z, 21), filling])
