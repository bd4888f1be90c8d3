"""The two end walls: the great door in the west, the tall window over the stairs in the east."""
import math
import numpy as np
from plan import ARCADE_Y, WALL_Y, WALL_DEPTH, GALLERY, EAVES, VAULT_RISE
from architecture import archivolt, frame, sill_stone, window_bars
from shapes import box, cylinder, join, lathe, prism, sweep

TOP = EAVES + VAULT_RISE + 0.6
HALF_WIDTH = WALL_Y + WALL_DEPTH


def gable(radius, sill, spring, thick):
    """An end wall with one arched opening; its face at y = 0 looks toward -y, the opening's middle at x = 0."""
    halves = []
    for side in (-1, 1):
        arc = [(side * radius * math.cos(t), spring + radius * math.sin(t)) for t in np.linspace(0, math.pi / 2, 13)]
        outline = [(side * HALF_WIDTH, -0.1), (0.0, -0.1), (0.0, sill), (side * radius, sill)] + arc
        outline += [(0.0, TOP), (side * HALF_WIDTH, TOP)]
        seams = (1, len(outline) - 3)
        halves.append(prism(outline, 0.0, thick, 'ashlar', skip=seams))
    return join(halves)


def band(z, height, depth, x0, x1):
    """A moulding along the end wall."""
    profile = [
        (0.02, z),
        (-0.5 * depth, z),
        (-0.6 * depth, z + 0.35 * height),
        (-depth, z + 0.55 * height),
        (-depth, z + height),
        (0.02, z + height),
    ]
    return prism(profile, x0, x1, axis='x')


def east_wall():
    """A tall three-light window above the landing."""
    radius, sill, spring = 1.3, 4.1, 6.6
    parts = [
        gable(radius, sill, spring, 0.6),
        frame(radius, 0.24, 0.09, sill, spring, 0.0),
        sill_stone(radius, sill, 0.0),
        band(GALLERY - 0.2, 0.2, 0.1, -HALF_WIDTH + 1, -radius - 0.26),
        band(GALLERY - 0.2, 0.2, 0.1, radius + 0.26, HALF_WIDTH - 1),
    ]
    return join(parts + window_bars(radius, sill, spring, 0.4, 3, 6, 0.03))


def west_wall():
    """The great door: a stepped portal with shafts, two leaves of oak, a roundel above."""
    radius, spring = 1.6, 2.9
    parts = [gable(radius, -0.05, spring, 0.6)]
    parts += [archivolt(radius, 0.26, 0.08, 0.0, -1, spring), archivolt(radius + 0.28, 0.22, 0.16, 0.0, -1, spring)]
    for side in (-1, 1):
        parts += [
            jamb_shaft(side * (radius + 0.26)),
            box(
                (side * (radius + 0.26) - 0.30, -0.34, -0.05),
                (side * (radius + 0.26) + 0.30, 0.02, 0.14),
                'stone',
                bevel=0.02,
            ),
            box(
                (side * (radius + 0.26) - 0.29, -0.32, spring - 0.18),
                (side * (radius + 0.26) + 0.29, 0.02, spring + 0.01),
                'stone',
                bevel=0.02,
            ),
        ]
    parts += [band(GALLERY + 0.35, 0.24, 0.16, -3.2, 3.2), roundel().moved(0, 0, 6.5)]
    for x0, x1 in (
        (-HALF_WIDTH + 1, -ARCADE_Y - 0.3),
        (ARCADE_Y + 0.3, HALF_WIDTH - 1),
        (-ARCADE_Y + 0.3, -radius - 0.6),
        (radius + 0.6, ARCADE_Y - 0.3),
    ):
        parts.append(
            prism([(0.02, -0.05), (-0.07, -0.05), (-0.07, 0.30), (-0.025, 0.40), (0.02, 0.40)], x0, x1, axis='x')
        )
    return join(parts + [door_leaves(radius, spring)])


def jamb_shaft(x):
    """A slender column beside the door."""
    profile = [
        (0.17, 0.12),
        (0.18, 0.16),
        (0.16, 0.2),
        (0.12, 0.22),
        (0.13, 0.26),
        (0.10, 0.29),
        (0.10, 2.3),
        (0.125, 2.33),
        (0.10, 2.36),
        (0.13, 2.5),
        (0.165, 2.66),
        (0.165, 2.74),
    ]
    return lathe(profile, 14, 'stone', caps=(False, False)).moved(x, -0.15, 0)


def roundel():
    """A great moulded disc over the door."""
    petals = lambda angle, r, z: r * (1 + 0.10 * math.cos(8 * angle)) if 0.3 < r < 0.75 else r
    profile = [
        (1.25, -0.02),
        (1.25, 0.06),
        (1.17, 0.12),
        (1.07, 0.12),
        (1.0, 0.055),
        (0.74, 0.05),
        (0.62, 0.11),
        (0.34, 0.05),
        (0.22, 0.13),
        (0.0, 0.165),
    ]
    return lathe(profile, 24, 'stone', shape=petals, caps=(False, False)).turned('x', 90)


def door_leaves(radius, spring):
    """Oak boards of an arched double door, iron straps, studs, rings."""
    parts, count = [], 14
    for i in range(count):
        x0, x1 = -radius + 2 * radius * i / count, -radius + 2 * radius * (i + 1) / count
        gap = 0.008 if i != count // 2 - 1 else 0.012
        top = lambda x: spring + math.sqrt(max(0.0, (radius + 0.03) ** 2 - x * x))
        outline = [(x0 + gap, -0.02), (x1 - gap, -0.02), (x1 - gap, top(x1)), (x0 + gap, top(x0))]
        shade = 0.62 + 0.14 * ((i * 7) % 5) / 4
        board = prism(outline, 0.30, 0.38, 'wood', (shade, shade * 0.93, shade * 0.86))
        board.uvs = [[(v, u) for u, v in uv] for uv in board.uvs]
        parts.append(board)
    parts.append(box((-radius, 0.36, -0.02), (radius, 0.42, spring), 'wood', (0.25, 0.22, 0.2), grain=True))
    parts.append(
        prism(
            [(-radius, spring - 0.01)]
            + [
                ((radius + 0.02) * math.cos(t), spring + (radius + 0.02) * math.sin(t))
                for t in np.linspace(math.pi, 0, 17)
            ],
            0.37,
            0.42,
            'wood',
            (0.25, 0.22, 0.2),
        )
    )
    for side in (-1, 1):
        for z in (0.5, 1.6, 2.7):
            parts += strap(side, radius, z)
        ring = sweep(
            [(0.012 * math.cos(a), 0.012 * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 7)[:-1]],
            [
                (
                    (side * 0.22 + 0.09 * math.cos(a), 0.275, 1.15 + 0.09 * math.sin(a)),
                    (math.cos(a), 0, math.sin(a)),
                    (0, 1, 0),
                )
                for a in np.linspace(0, 2 * math.pi, 17)[:-1]
            ],
            'brass',
            closed=True,
        )
        parts += [ring, cylinder(0.03, 0.25, 0.31, 12, 'brass', axis='y').moved(side * 0.22, 0, 1.24)]
    return join(parts)


def strap(side, radius, z):
    lo, hi = sorted((side * 0.12, side * (radius - 0.02)))
    bar = box((lo, 0.285, z - 0.045), (hi, 0.31, z + 0.045), 'iron', bevel=0.008)
    studs = [
        lathe([(0.028, 0.0), (0.022, 0.014), (0.0, 0.02)], 8, 'iron', caps=(False, False))
        .turned('x', 90)
        .moved(side * (0.25 + 0.42 * i), 0.286, z)
        for i in range(4)
    ]
    return [bar] + studs
