"""A small steam engine: the bed is one body, the flywheel on its shaft another, a loose gear a third."""
import math
import numpy as np
from shapes import box, circle, cylinder, join, lathe, prism, ring_prism, rounded_path, solid, sweep, tube

SHAFT_Z, SHAFT_X, SHAFT_RADIUS = 1.02, 0.95, 0.045
WHEEL_RADIUS, WHEEL_Y = 0.82, 0.62
TEAL, IRON, BRASS = 'teal', 'iron', 'brass'


def engine_bed():
    """Bed, cylinder, guides, crank, shaft in its bearings, small gears, pipes and gauge. x is along the cylinder."""
    parts = [
        box((-1.3, -0.42, 0.0), (1.35, 0.42, 0.10), IRON, bevel=0.02),
        box((-1.22, -0.34, 0.10), (1.27, 0.34, 0.34), TEAL, bevel=0.025),
        box((-1.26, -0.38, 0.34), (1.31, 0.38, 0.40), TEAL, bevel=0.015),
    ]
    for x in np.linspace(-1.2, 1.25, 8):
        parts += [bolt(0.02, 0.016).moved(x, s * 0.39, 0.10) for s in (-1, 1)]
    for x in (-0.85, -0.25, 0.35, 0.95):
        parts += [
            box((x - 0.22, s * 0.345 - 0.008, 0.155), (x + 0.22, s * 0.345 + 0.008, 0.29), TEAL, (0.8, 0.8, 0.8))
            for s in (-1, 1)
        ]
    return join(parts + steam_cylinder() + motion() + bearings() + timing_gears() + pipes() + gauge())


def bolt(radius, height):
    return lathe([(radius, -0.002), (radius, height), (0.0, height)], 6, IRON, caps=(False, False))


def ring_of_bolts(count, radius, x, z, direction):
    """Bolt heads around an axis along x, at x."""
    out = []
    for i in range(count):
        a = 2 * math.pi * (i + 0.5) / count
        out.append(
            bolt(0.016, 0.018).turned('y', 90 * direction).moved(x, radius * math.cos(a), z + radius * math.sin(a))
        )
    return out


def steam_cylinder():
    """A lagged barrel between bolted flanges, on two saddles, with the valve chest on its side."""
    z, x0, x1 = SHAFT_Z, -1.15, -0.35
    barrel = cylinder(0.235, x0 + 0.05, x1 - 0.05, 24, 'wood', (0.62, 0.5, 0.4), axis='x').moved(0, 0, z)
    barrel.uvs = [[(v, u) for u, v in uv] for uv in barrel.uvs]
    parts = [barrel]
    for x in (x0 + 0.2, (x0 + x1) / 2, x1 - 0.2):
        parts.append(cylinder(0.243, x - 0.02, x + 0.02, 24, BRASS, axis='x').moved(0, 0, z))
    cover = [
        (0.0, -0.085),
        (0.10, -0.085),
        (0.13, -0.06),
        (0.20, -0.05),
        (0.225, -0.03),
        (0.285, -0.03),
        (0.29, -0.02),
        (0.29, 0.03),
        (0.0, 0.03),
    ]
    for x, turn, side in ((x0, 90, -1), (x1, -90, 1)):
        parts.append(lathe(cover, 24, TEAL, phase=0.5).turned('y', turn).moved(x + side * 0.02 * 0, 0, z))
        parts += ring_of_bolts(10, 0.255, x + side * 0.03, z, side)
    for x in (x0 + 0.12, x1 - 0.12):
        saddle = [(-0.20, 0.39), (0.20, 0.39), (0.15, 0.55), (0.15, z - 0.1), (-0.15, z - 0.1), (-0.15, 0.55)]
        parts.append(prism(saddle, x - 0.07, x + 0.07, TEAL, axis='x'))
    parts += [
        box((x0 + 0.16, -0.42, z - 0.15), (x1 - 0.16, -0.20, z + 0.15), TEAL, bevel=0.015),
        box((x0 + 0.13, -0.45, z - 0.18), (x1 - 0.13, -0.42, z + 0.18), TEAL, bevel=0.01),
    ]
    for i in range(4):
        for s in (-1, 1):
            parts.append(bolt(0.015, 0.018).turned('x', 90).moved(x0 + 0.20 + i * 0.133, -0.45, z + s * 0.15))
    return parts


def motion():
    """Piston rod, crosshead between guide bars, connecting rod, crank disc and pin."""
    z, cross_x, pin_angle = SHAFT_Z, 0.12, math.radians(125)
    pin = (SHAFT_X + 0.24 * math.cos(pin_angle), z + 0.24 * math.sin(pin_angle))
    parts = [
        cylinder(0.03, -0.40, cross_x, 12, 'iron', (1, 1, 1), axis='x').moved(0, 0, z),
        box((cross_x - 0.07, -0.06, z - 0.085), (cross_x + 0.07, 0.06, z + 0.085), BRASS, bevel=0.01),
    ]
    for s in (-1, 1):
        parts.append(box((-0.34, -0.05, z + s * 0.11 - 0.022), (0.46, 0.05, z + s * 0.11 + 0.022), IRON, bevel=0.005))
    parts.append(
        prism(
            [(-0.10, 0.39), (0.10, 0.39), (0.05, 0.6), (0.05, z - 0.13), (-0.05, z - 0.13), (-0.05, 0.6)],
            0.38,
            0.45,
            TEAL,
            axis='x',
        )
    )
    parts.append(box((0.42, -0.05, z - 0.09), (0.45, 0.05, z + 0.09), IRON))
    dx, dz = pin[0] - cross_x, pin[1] - z
    length, lean = math.hypot(dx, dz), math.degrees(math.atan2(dz, dx))
    rod = join(
        [
            box((0.0, -0.02, -0.03), (length, 0.02, 0.03), IRON, bevel=0.008),
            cylinder(0.065, -0.03, 0.03, 14, BRASS, axis='y', bevel=0.006).moved(length, 0, 0),
            cylinder(0.05, -0.085, 0.085, 12, IRON, axis='y'),
        ]
    )
    parts.append(rod.turned('y', -lean).moved(cross_x, 0.0, z))
    parts += [
        lathe(
            [
                (0.0, -0.03),
                (0.29, -0.03),
                (0.30, -0.02),
                (0.30, 0.02),
                (0.27, 0.03),
                (0.24, 0.02),
                (0.10, 0.02),
                (0.09, 0.04),
                (0.0, 0.04),
            ],
            24,
            TEAL,
        )
        .turned('x', -90)
        .moved(SHAFT_X, 0.09, z),
        cylinder(0.032, -0.045, 0.09, 12, IRON, axis='y').moved(pin[0], 0, pin[1]),
    ]
    return parts


def bearings():
    """Two pillow blocks and the shaft from the crank to beyond the flywheel."""
    parts = [cylinder(SHAFT_RADIUS, 0.10, WHEEL_Y + 0.16, 20, IRON, axis='y').moved(SHAFT_X, 0, SHAFT_Z)]
    for y, half in ((0.26, 0.075),):
        foot = [
            (SHAFT_X - 0.30, 0.39),
            (SHAFT_X + 0.30, 0.39),
            (SHAFT_X + 0.27, 0.48),
            (SHAFT_X + 0.13, 0.62),
            (SHAFT_X + 0.13, SHAFT_Z),
            (SHAFT_X - 0.13, SHAFT_Z),
            (SHAFT_X - 0.13, 0.62),
            (SHAFT_X - 0.27, 0.48),
        ]
        parts += [
            prism(foot, y - half, y + half, TEAL),
            cylinder(0.13, y - half + 0.004, y + half - 0.004, 20, TEAL, axis='y').moved(SHAFT_X, 0, SHAFT_Z),
            cylinder(0.075, y - half - 0.02, y + half + 0.02, 20, BRASS, axis='y', bevel=0.006).moved(
                SHAFT_X, 0, SHAFT_Z
            ),
            cylinder(0.02, 0.12, 0.19, 10, BRASS, bevel=0.006).moved(SHAFT_X, y, SHAFT_Z),
        ]
        parts += [bolt(0.022, 0.03).moved(SHAFT_X + s * 0.215, y, 0.53) for s in (-1, 1)]
    return parts


def gear_outline(teeth, pitch_radius, depth, shift=0.0):
    """Trapezoid teeth: (x, y), four points each."""
    out = []
    for i in range(teeth):
        for f, r in ((-0.30, -0.55), (-0.14, 0.45), (0.14, 0.45), (0.30, -0.55)):
            a = 2 * math.pi * (i + f + shift) / teeth
            out.append(((pitch_radius + r * depth) * math.cos(a), (pitch_radius + r * depth) * math.sin(a)))
    return out


def gear(teeth, pitch_radius, depth, half, hole, material=IRON, shift=0.0):
    """A gear about z with a recessed web, a hub and a hole."""
    outer = gear_outline(teeth, pitch_radius, depth, shift)
    inner = [math.atan2(y, x) for x, y in outer]
    rim, hub = pitch_radius - 1.5 * depth, hole * 1.9
    return join(
        [
            ring_prism(outer, [(rim * math.cos(a), rim * math.sin(a)) for a in inner], -half, half, material),
            ring_prism(circle(rim + 0.004, 24), circle(hub - 0.004, 24), -0.45 * half, 0.45 * half, material),
            ring_prism(circle(hub, 16), circle(hole, 16), -1.25 * half, 1.25 * half, material),
        ]
    )


def timing_gears():
    """A pair of gears on the crank side drives the governor's shaft."""
    big = gear(26, 0.26, 0.035, 0.03, 0.05, BRASS).turned('x', 90).moved(SHAFT_X, 0.155, SHAFT_Z)
    small = (
        gear(13, 0.13, 0.035, 0.03, 0.03, IRON, 0.5)
        .turned('x', 90)
        .turned('y', 14)
        .moved(SHAFT_X - 0.30, 0.155, SHAFT_Z - 0.25)
    )
    post = [
        box((SHAFT_X - 0.35, 0.20, 0.39), (SHAFT_X - 0.25, 0.30, SHAFT_Z - 0.17), TEAL, bevel=0.01),
        cylinder(0.03, 0.10, 0.32, 14, IRON, axis='y').moved(SHAFT_X - 0.30, 0, SHAFT_Z - 0.25),
    ]
    return [small, big] + post


def flange(radius=0.075):
    return lathe([(0.0, -0.018), (radius, -0.018), (radius, 0.018), (0.0, 0.018)], 16, BRASS)


def pipes():
    """Steam in from above, exhaust down into the floor plate, a thin oil line; a wheel valve."""
    z = SHAFT_Z
    steam = rounded_path(
        [(-0.75, -0.33, z + 0.15), (-0.75, -0.33, 1.62), (-1.42, -0.33, 1.62), (-1.42, -0.33, 0.02)], 0.14, 5
    )
    exhaust = rounded_path(
        [(-0.55, -0.33, z - 0.14), (-0.55, -0.33, 0.62), (-0.55, -0.52, 0.62), (-0.55, -0.52, 0.02)], 0.07, 4
    )
    oil = rounded_path(
        [(SHAFT_X, 0.26, z + 0.18), (SHAFT_X, 0.26, z + 0.34), (0.30, 0.16, z + 0.34), (0.30, 0.16, 0.40)], 0.06, 3
    )
    parts = [tube(steam, 0.045, 12, BRASS), tube(exhaust, 0.04, 10, IRON), tube(oil, 0.011, 6, BRASS)]
    for p in ((-0.75, -0.33, z + 0.18), (-0.75, -0.33, 1.36), (-1.42, -0.33, 0.9), (-0.55, -0.33, z - 0.18)):
        parts.append(flange().moved(*p))
    for x, y in ((-1.42, -0.33), (-0.55, -0.52)):
        parts.append(cylinder(0.09, 0.0, 0.03, 16, IRON, bevel=0.006).moved(x, y, 0))
    return parts + wheel_valve((-1.42, -0.33, 1.15))


def wheel_valve(at):
    body = lathe([(0.0, -0.10), (0.06, -0.10), (0.085, -0.04), (0.085, 0.04), (0.06, 0.10), (0.0, 0.10)], 14, TEAL)
    stem = cylinder(0.014, 0.0, 0.20, 8, BRASS, axis='y').stretched(1, -1, 1)
    rim = sweep(
        circle(0.012, 6),
        [
            ((0.10 * math.cos(a), -0.19, 0.10 * math.sin(a)), (math.cos(a), 0, math.sin(a)), (0, 1, 0))
            for a in np.linspace(0, 2 * math.pi, 19)[:-1]
        ],
        'ochre',
        closed=True,
    )
    spokes = [box((0.0, -0.197, -0.008), (0.10, -0.183, 0.008), 'ochre').turned('y', 90 * i + 20) for i in range(4)]
    return [p.moved(*at) for p in [body, stem, rim] + spokes]


def gauge():
    """A pressure gauge on a bent neck above the valve chest."""
    neck = tube(
        rounded_path(
            [(-0.95, -0.33, SHAFT_Z + 0.14), (-0.95, -0.33, SHAFT_Z + 0.36), (-0.95, -0.40, SHAFT_Z + 0.42)], 0.03, 3
        ),
        0.012,
        6,
        BRASS,
    )
    case = lathe(
        [(0.0, 0.0), (0.08, 0.0), (0.085, 0.01), (0.085, 0.045), (0.075, 0.05), (0.07, 0.04)],
        18,
        BRASS,
        caps=(False, False),
    )
    dial = lathe([(0.075, 0.035), (0.0, 0.036)], 18, 'paper', caps=(False, False))
    hand = box((-0.004, -0.01, 0.034), (0.004, 0.055, 0.041), 'iron').turned('z', -35)
    head = join([case, dial, hand]).turned('x', 90).moved(-0.95, -0.40, SHAFT_Z + 0.44)
    return [neck, head]


def flywheel():
    """Six bellied spokes; its axis is y, its middle the origin. The bore clears the shaft by half a millimetre."""

    def ring(r0, r1, half, crown, segments, material):
        profile = [
            (r0, -half),
            (r1 - crown, -half),
            (r1, -half + crown),
            (r1, half - crown),
            (r1 - crown, half),
            (r0, half),
            (r0, -half),
        ]
        return solid(lathe(profile, segments, material, caps=(False, False), phase=0.5))

    parts = [
        ring(WHEEL_RADIUS - 0.11, WHEEL_RADIUS, 0.075, 0.012, 48, TEAL),
        ring(SHAFT_RADIUS + 0.0006, 0.13, 0.10, 0.012, 20, TEAL),
    ]
    for i in range(6):
        spoke = lathe(
            [(0.048, 0.115), (0.042, 0.2), (0.034, 0.45), (0.034, 0.62), (0.045, WHEEL_RADIUS - 0.10)], 10, TEAL
        ).stretched(1.15, 0.75, 1)
        parts.append(spoke.turned('y', 60 * i + 11))
    wheel = join([parts[0].turned('x', 90), parts[1].turned('x', 90)] + parts[2:])
    return wheel


def loose_gear():
    """A spare gear lying flat, its origin at the middle of its underside."""
    out = gear(22, 0.27, 0.05, 0.04, 0.05)
    return out.moved(0, 0, -float(out.points[:, 2].min()))
