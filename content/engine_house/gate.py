"""The wrought-iron gate: a leaf hung on the origin's upright axis, its mirror image, and the stone post between."""
import math
import numpy as np
from machine import gear_outline
from shapes import box, cylinder, join, lathe, ring_prism, solid, square_lathe, sweep, tube
from solids import ball, turned_solid

LENGTH, LOW, HIGH = 1.30, 0.02, 1.77
HEEL = 0.027  # radius of the round stile on the hinge axis
STILE = 0.05  # width of the stile where the leaves meet
BARS, BAR = 7, 0.017  # between the stiles; radius
HINGES = (0.30, 1.22)
BAND = (0.70, 0.86)  # undersides of the two rails that hold the rings
EMBLEM_Z = 1.185


def gate_left():
    """The leaf that reaches to +x; z is up, its middle plane is y = 0."""
    step = (LENGTH - STILE - HEEL) / (BARS + 1)
    bars = [HEEL + step * (i + 1) for i in range(BARS)]
    gaps = [HEEL + step * (i + 0.5) for i in range(BARS + 1)]
    parts = stiles() + rails() + emblem(bars[BARS // 2])
    for x in bars:
        parts += bar(x)
    for x in gaps:
        parts.append(cylinder(0.0155, 0.085, BAND[0] + 0.015, 10, 'wrought').moved(x, 0, 0))
        parts.append(ring(0.0505).moved(x, 0, (BAND[0] + 0.035 + BAND[1]) / 2))
    return join(parts)


def gate_right():
    return gate_left().stretched(-1, 1, 1)


def top_rail(x):
    """The height of the swan-necked top rail's middle above x."""
    t = np.clip((x - 0.10) / (LENGTH - 0.20), 0, 1)
    return 1.40 + 0.195 * t * t * (3 - 2 * t)


def stiles():
    heel_top = top_rail(0.0) + 0.06
    heel = cylinder(HEEL, LOW, heel_top, 14, 'wrought', bevel=0.004)
    parts = [heel, ball(0.043, 12, 7, 'wrought').moved(0, 0, heel_top + 0.03)]
    for z in HINGES:
        collar = [(0.0, -0.06), (0.030, -0.06), (0.034, -0.052), (0.034, 0.052), (0.030, 0.06), (0.0, 0.06)]
        parts.append(turned_solid(collar, 14, 'wrought').moved(0, 0, z))
    meeting_top = top_rail(LENGTH) + 0.02
    parts.append(box((LENGTH - STILE, -0.0225, LOW), (LENGTH, 0.0225, meeting_top), 'wrought', bevel=0.004))
    parts.append(spear(HIGH - meeting_top + 0.01, 0.73).moved(LENGTH - STILE / 2, 0, meeting_top - 0.01))
    return parts


def rails():
    parts = []
    for z, height in ((0.07, 0.05), (BAND[0], 0.035), (BAND[1], 0.035)):
        parts.append(box((0.0, -0.02, z), (LENGTH - STILE / 2, 0.02, z + height), 'wrought', bevel=0.004))
    frames = []
    for x in np.linspace(0.0, LENGTH - STILE / 2, 16):
        slope = (top_rail(x + 0.001) - top_rail(x - 0.001)) / 0.002
        long = math.hypot(1, slope)
        frames.append(((x, 0, top_rail(x)), (-slope / long, 0, 1 / long), (0, 1, 0)))
    profile = [(-0.019, -0.018), (0.015, -0.018), (0.019, -0.014), (0.019, 0.014), (0.015, 0.018), (-0.019, 0.018)]
    return parts + [sweep(profile, frames, 'wrought')]


def bar(x):
    """An upright through all rails, with a knop at half of the upper panel's height and a spear above the rail."""
    top = top_rail(x) + 0.025
    middle = (BAND[1] + 0.035 + top_rail(x)) / 2
    parts = [
        cylinder(BAR, 0.085, top, 10, 'wrought').moved(x, 0, 0),
        spear(0.145).moved(x, 0, top - 0.01),
    ]
    if abs(x - (HEEL + LENGTH - STILE) / 2) > 0.2:
        parts.append(ball(0.031, 10, 6, 'wrought').moved(x, 0, middle))
    return parts


def spear(height, width=1.0):
    """A blunt leaf-shaped point on a collar; it widens to 0.034 m times `width`."""
    profile = [(0.0, 0.0), (0.027, 0.0), (0.027, 0.020), (0.018, 0.036)]
    leaf = ((0.034, 0.30), (0.028, 0.58), (0.0145, 0.93), (0.0, 1.0))
    profile += [(r, 0.036 + t * (height - 0.036)) for r, t in leaf]
    return solid(lathe(profile, 10, 'wrought', caps=(False, False))).stretched(width, width, 1)


def ring(radius):
    way = [(radius * math.cos(a), 0, radius * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 13)[:-1]]
    return tube(way, 0.0150, 10, 'wrought', closed=True)


def emblem(x):
    """A brass gear before and behind the bars, with a boss in its middle."""
    teeth = gear_outline(12, 0.175, 0.04)
    around = [math.atan2(b, a) for a, b in teeth]
    wheel = ring_prism(teeth, [(0.12 * math.cos(a), 0.12 * math.sin(a)) for a in around], -0.024, 0.024, 'brass')
    boss = [(0.0, -0.034), (0.03, -0.034), (0.05, -0.022), (0.05, 0.022), (0.03, 0.034), (0.0, 0.034)]
    spokes = [
        box((0.03, -0.015, -0.015), (0.13, 0.015, 0.015), 'brass').turned('y', 60 * i) for i in range(6) if i % 3
    ]
    spokes += [box((0.03, -0.015, -0.015), (0.13, 0.015, 0.015), 'brass').turned('y', 180 * i) for i in range(2)]
    parts = [wheel.turned('x', 90), turned_solid(boss, 18, 'brass').turned('x', 90)] + spokes
    return [p.moved(x, 0, EMBLEM_Z) for p in parts]


# ---- the post ----


def gate_post():
    """0.26 x 0.26 m at its foot, iron bands and cap; a pyramid with a ball, 1.95 m high."""
    stone = [
        (0.0, 0.0),
        (0.13, 0.0),
        (0.13, 0.20),
        (0.114, 0.225),
        (0.114, 1.58),
        (0.122, 1.60),
        (0.122, 1.64),
        (0.13, 1.66),
        (0.13, 1.72),
        (0.123, 1.73),
        (0.05, 1.80),
        (0.0, 1.80),
    ]
    parts = [square_lathe(stone, 'stone', caps=(False, False))]
    for z in HINGES:
        parts.append(iron_band(z))
    neck = [(0.0, 1.78), (0.048, 1.78), (0.048, 1.80), (0.034, 1.815), (0.034, 1.83), (0.0, 1.83)]
    parts.append(turned_solid(neck, 20, 'stone'))
    parts.append(ball(0.072, 18, 10, 'stone').moved(0, 0, 1.878))
    return join(parts)


def iron_band(z):
    """Around the shaft where a leaf's hinge comes to lie."""
    square = lambda r: [(-r, -r), (r, -r), (r, r), (-r, r)]
    parts = [ring_prism(square(0.126), square(0.10), z - 0.04, z + 0.04, 'wrought')]
    return join(parts)
