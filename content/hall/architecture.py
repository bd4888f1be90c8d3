"""The hall itself: floor, arcades, galleries, walls. Bays are modelled once and drawn many times."""
import math
import random
import numpy as np
from plan import BAY, ARCADE_Y, ARCADE_HALF, WALL_Y, WALL_DEPTH, SPRING, ARCH_RADIUS, GALLERY, EAVES
from shapes import arc_frames, box, join, lathe, make, prism, rings, square_lathe, sweep

HALF_BAY = BAY / 2
WALL_TINT = (1.0, 0.93, 0.80)  # warm cream
NICHE_TINT = (0.93, 0.74, 0.58)  # terracotta wash


# ---- floor ----


def tile(x, y, rng, tint):
    """One slab of 1 x 1 m whose cut edges leave a sunken joint."""
    cut, deep, half = 0.009, 0.008, 0.5 - 0.004
    cut = cut if abs(y) < 5.0 else 0.0  # upright edges in the aisles, where nobody looks closely
    shade = rng.uniform(0.90, 1.0)
    shift = (rng.randrange(4) * 0.5, rng.randrange(4) * 0.5)
    loops = [
        [(x + sx * (half - d), y + sy * (half - d), z) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        for d, z in ((0.0, -deep), (cut, 0.0))
    ]
    out = rings(loops, 'marble', tuple(shade * c for c in tint), ends=(False, True))
    out.uvs = [[(u + shift[0], v + shift[1]) for u, v in uv] for uv in out.uvs]
    return out


def floor():
    """Marble in two tones down the nave, a plain border under the arcades, the bed of the joints below."""
    rng = random.Random(7)
    light, dark, border = (1.0, 0.97, 0.92), (0.60, 0.43, 0.36), (0.86, 0.79, 0.68)
    tiles = []
    for i in range(24):
        for j in range(14):
            x, y = -11.5 + i, -6.5 + j
            tint = border if 4.0 < abs(y) < 5.0 else (light, dark)[(i + j) % 2]
            tiles.append(tile(x, y, rng, tint))
    bed = make(
        [(-12.2, -7.2, -0.007), (12.2, -7.2, -0.007), (12.2, 7.2, -0.007), (-12.2, 7.2, -0.007)],
        [(0, 1, 2, 3)],
        'stone',
        (0.55, 0.5, 0.44),
    )
    under = box((-12.6, -8.0, -0.4), (12.6, 8.0, -0.2), 'stone')
    return join(tiles + [bed, under])


# ---- arcade ----


def column():
    """Base, shaft with entasis, and a leafy capital that turns from round to square. Its foot is at the origin."""
    base = [(0.33, 0.11), (0.352, 0.16), (0.335, 0.20), (0.287, 0.235), (0.308, 0.28), (0.265, 0.31)]
    shaft = [(0.25, 0.34), (0.243, 1.2), (0.215, 1.98)]
    neck = [(0.243, 2.0), (0.243, 2.04)]
    bell = [(0.215, 2.06), (0.24, 2.17), (0.32, 2.31), (0.345, 2.34), (0.33, 2.37)]

    def leaves(angle, r, z):
        if z < 2.08 or r == 0:
            return r
        grow = min(1.0, (z - 2.06) / 0.28)
        return r * (1 + 0.075 * grow * math.cos(8 * angle))

    round_part = lathe(base + shaft + neck + bell, 16, 'stone', shape=leaves, phase=0.0, caps=(False, False))
    plinth = square_lathe([(0.37, -0.05), (0.37, 0.105), (0.355, 0.12)], caps=(False, True))
    abacus = square_lathe([(0.33, 2.36), (0.35, 2.38), (0.375, 2.40), (0.375, SPRING - 0.015), (0.36, SPRING)])
    return join([round_part, plinth, abacus])


def arch_outline(left, right, bottom, spring, radius, top, steps=14):
    """Above an arch: (x, z) counter-clockwise, with the arch's edge running from +radius to -radius."""
    arc = [(radius * math.cos(t), spring + radius * math.sin(t)) for t in np.linspace(math.pi, 0, steps + 1)]
    return [(left, top), (left, bottom)] + arc + [(right, bottom), (right, top)]


def archivolt(radius, width, depth, y, outward, spring, steps=14):
    """A stepped moulding around a half circle, standing `depth` out of a wall face at y."""
    profile = [
        (0.012, -0.02),
        (0.012, 0.55 * depth),
        (0.6 * width, 0.6 * depth),
        (0.7 * width, depth),
        (width, depth),
        (width, -0.02),
    ]
    return sweep(profile, arc_frames(radius, 0, math.pi, steps + 1, (0, spring), y, outward), 'stone')


def along_x(profile, x0, x1, material='stone', caps=(False, False)):
    """A moulding along x: the profile is (y, z)."""
    return prism(profile, x0, x1, material, axis='x', caps=caps)


def keystone(y, outward):
    z0, z1 = SPRING + ARCH_RADIUS - 0.03, SPRING + ARCH_RADIUS + 0.23
    wedge = [(-0.085, z0), (0.085, z0), (0.13, z1), (-0.13, z1)]
    lo, hi = sorted((y - 0.02 * outward, y + 0.10 * outward))
    return prism(wedge, lo, hi)


def arcade_bay():
    """One arch with its spandrels; +y looks into the nave. Origin: mid-bay on the floor, on the columns' axis."""
    t = ARCADE_HALF
    top = GALLERY - 0.02
    outline = arch_outline(-HALF_BAY, HALF_BAY, SPRING, SPRING, ARCH_RADIUS, top)
    wall = prism(outline, -t, t, 'ashlar', skip=(0, len(outline) - 2))
    cornice = [
        (t - 0.02, 4.31),
        (t + 0.03, 4.31),
        (t + 0.04, 4.35),
        (t + 0.09, 4.38),
        (t + 0.16, 4.42),
        (t + 0.16, 4.45),
        (t + 0.21, 4.47),
        (t + 0.21, GALLERY),
        (t - 0.1, GALLERY),
    ]
    parts = [wall, along_x(cornice, -HALF_BAY, HALF_BAY)]
    for side in (1, -1):
        parts += [archivolt(ARCH_RADIUS, 0.20, 0.07, side * t, side, SPRING), keystone(side * t, side)]
    return join(parts)


def gallery_slab():
    """The gallery's floor over one bay: boards, a stone kerb, beams below. Same origin as arcade_bay."""
    inner, outer = -0.28, -(WALL_Y - ARCADE_Y) - 0.02
    slab = box((-HALF_BAY, outer, 4.36), (HALF_BAY, -0.21, GALLERY - 0.03), 'wood', (0.8, 0.74, 0.68), grain=True)
    kerb = box((-HALF_BAY, -0.24, 4.36), (HALF_BAY, 0.2, GALLERY), 'stone')
    beams = gallery_boards(outer, -0.24)
    for x, half in ((-HALF_BAY, 0.0), (-HALF_BAY / 3, 0.09), (HALF_BAY / 3, 0.09)):
        if half:
            beams.append(box((x - half, outer, 4.18), (x + half, inner, 4.37), 'wood', (0.62, 0.56, 0.5), grain=True))
    plate = [(inner + 0.0, 4.02), (inner + 0.0, 4.19), (inner - 0.12, 4.19), (inner - 0.12, 4.08), (inner - 0.06, 4.02)]
    return join([slab, kerb, along_x(plate, -HALF_BAY, HALF_BAY)] + beams)


def gallery_boards(outer, inner):
    """Floor boards along the gallery, with narrow gaps."""
    rng, count, out = random.Random(2), 9, []
    for i in range(count):
        y0, y1 = outer + (inner - outer) * i / count, outer + (inner - outer) * (i + 1) / count
        shade = rng.uniform(0.72, 0.95)
        board = box(
            (-HALF_BAY, y0 + 0.004, GALLERY - 0.03),
            (HALF_BAY, y1 - 0.004, GALLERY),
            'wood',
            (shade, 0.95 * shade, 0.9 * shade),
            grain=True,
        )
        board.uvs = [[(u, v + 0.37 * i) for u, v in uv] for uv in board.uvs]
        out.append(board)
    return out


def gallery_beam():
    """A stone beam over each column from the arcade to the wall, on a bracket. Origin: the column's foot."""
    outer = -(WALL_Y - ARCADE_Y) - 0.02
    beam = box((-0.19, outer, 4.0), (0.19, -0.28, 4.38), 'stone', bevel=0.02)
    bracket = [
        (outer, 3.55),
        (outer + 0.22, 3.62),
        (outer + 0.30, 3.75),
        (outer + 0.42, 3.85),
        (outer + 0.46, 4.01),
        (outer, 4.01),
    ]
    return join([beam, prism(bracket, -0.15, 0.15, axis='x')])


BALUSTER = [
    (0.056, 0.0),
    (0.054, 0.055),
    (0.036, 0.075),
    (0.066, 0.21),
    (0.053, 0.31),
    (0.031, 0.43),
    (0.048, 0.52),
    (0.056, 0.62),
]


def balustrade(length, count):
    """Balusters between two rails, from x = 0 to `length`, the post at x = 0. +y looks out. Stands on z = 0."""
    foot = [(-0.12, 0.0), (0.12, 0.0), (0.12, 0.10), (0.09, 0.14), (-0.09, 0.14), (-0.12, 0.10)]
    rail = [
        (-0.09, 0.74),
        (0.09, 0.74),
        (0.13, 0.78),
        (0.14, 0.83),
        (0.11, 0.88),
        (-0.11, 0.88),
        (-0.14, 0.83),
        (-0.13, 0.78),
    ]
    parts = [along_x(foot, 0.16, length - 0.16), along_x(rail, 0.16, length - 0.16), pedestal()]
    clear = length - 0.36
    for i in range(count):
        turned = lathe(BALUSTER, 7, 'stone', phase=0.5, caps=(False, False))
        parts.append(turned.moved(0.18 + clear * (i + 0.5) / count, 0, 0.13))
    return join(parts)


def pedestal():
    """The square post of a balustrade, moulded at foot and head."""
    profile = [
        (0.19, 0.0),
        (0.19, 0.11),
        (0.165, 0.15),
        (0.165, 0.74),
        (0.185, 0.77),
        (0.20, 0.83),
        (0.20, 0.90),
        (0.17, 0.93),
    ]
    return square_lathe(profile, caps=(False, True))


# ---- long walls ----


def holed_wall(radius, sill, spring, bottom, top, front, back, material, caps, reveal):
    """A bay of wall with a round-arched opening, in two halves. front, back: y. reveal: its sides too."""
    halves = []
    for side in (-1, 1):
        arc = [(side * radius * math.cos(t), spring + radius * math.sin(t)) for t in np.linspace(0, math.pi / 2, 7)]
        outline = [(side * HALF_BAY, bottom), (0.0, bottom), (0.0, sill), (side * radius, sill)] + arc
        outline += [(0.0, top), (side * HALF_BAY, top)]
        n = len(outline)
        seams = {1, n - 3, n - 1}
        opening = set(range(2, n - 3))
        skip = seams if reveal else seams | opening
        halves.append(prism(outline, front, back, material, skip=skip, caps=caps))
    return join(halves)


def apse(radius, depth, sill, spring, y, steps=10):
    """The inside of a niche: half a cylinder under a quarter of a sphere, seen from -y."""
    around = np.linspace(0, math.pi, steps + 1)
    at = lambda a, r, z: (r * math.cos(a), y + depth * (r / radius) * math.sin(a), z)
    loops = [[at(a, radius, sill) for a in around], [at(a, radius, spring) for a in around]]
    for t in np.linspace(0, math.pi / 2, 7)[1:]:
        loops.append([at(a, radius * math.cos(t), spring + radius * math.sin(t)) for a in around])
    loops[-1] = [(0.0, y, spring + radius)] * (steps + 1)
    shell = rings(loops, 'plaster', NICHE_TINT, around=False)
    ledge = make([at(a, radius, sill) for a in around], [tuple(range(steps + 1))], 'stone')
    return join([shell.flipped(), ledge])


def frame(radius, width, depth, sill, spring, y):
    """A moulding around an arched opening, down its sides to the sill; stands toward -y."""
    profile = [
        (0.01, -0.02),
        (0.01, 0.6 * depth),
        (0.4 * width, 0.6 * depth),
        (0.55 * width, depth),
        (width, depth),
        (width, -0.02),
    ]
    way = arc_frames(radius, 0, math.pi, 13, (0, spring), y, -1)
    way = [((radius, y, sill), (1, 0, 0), (0, -1, 0))] + way + [((-radius, y, sill), (-1, 0, 0), (0, -1, 0))]
    return sweep(profile, way, 'stone')


def sill_stone(radius, sill, y):
    profile = [
        (y + 0.05, sill - 0.16),
        (y - 0.04, sill - 0.16),
        (y - 0.06, sill - 0.09),
        (y - 0.13, sill - 0.06),
        (y - 0.13, sill),
        (y + 0.05, sill),
    ]
    return along_x(profile, -radius - 0.24, radius + 0.24, caps=(True, True))


def pilaster(width, depth, bottom, top, y):
    """A flat pier on a wall face at y, toward -y, with base and cap."""

    def block(extra, z0, z1):
        return box((-width / 2 - extra, y - depth - extra, z0), (width / 2 + extra, y + 0.02, z1), 'stone')

    shaft = box((-width / 2, y - depth, bottom), (width / 2, y + 0.02, top - 0.01), 'ashlar')
    return join(
        [
            shaft,
            block(0.06, bottom, bottom + 0.22),
            block(0.035, bottom + 0.2, bottom + 0.3),
            block(0.03, top - 0.32, top - 0.27),
            block(0.03, top - 0.17, top - 0.1),
            block(0.065, top - 0.11, top),
        ]
    )


def aisle_wall_bay():
    """Ground floor wall with an apse niche, a dado and a moulding; looks toward -y, its face at y = 0."""
    radius, sill, spring = 0.72, 0.62, 2.1
    wall = holed_wall(radius, sill, spring, -0.1, 4.4, 0.0, WALL_DEPTH, 'plaster', (True, True), False)
    outside = box((-HALF_BAY, WALL_DEPTH + 0.005, -0.1), (HALF_BAY, WALL_DEPTH + 0.05, 4.4), 'ashlar')
    dado = []
    skirting = [(0.02, -0.05), (-0.07, -0.05), (-0.07, 0.30), (-0.05, 0.34), (-0.025, 0.40), (0.02, 0.40)]
    impost = [(0.02, 2.02), (-0.03, 2.02), (-0.04, 2.06), (-0.07, 2.09), (-0.07, 2.15), (0.02, 2.15)]
    dado.append(along_x(skirting, -HALF_BAY, HALF_BAY))
    for x0, x1 in ((-HALF_BAY, -radius - 0.16), (radius + 0.16, HALF_BAY)):
        dado.append(along_x(impost, x0, x1, caps=(True, True)))
    return join(
        [
            wall.painted('plaster', WALL_TINT),
            outside,
            apse(radius, 0.72, sill, spring, 0.0),
            frame(radius, 0.16, 0.06, sill, spring, 0.0),
            sill_stone(radius, sill, 0.0),
        ]
        + dado
    )


def upper_cornice():
    """The moulding from which the vault springs, one bay long."""
    profile = [
        (0.02, EAVES - 0.30),
        (-0.04, EAVES - 0.30),
        (-0.05, EAVES - 0.24),
        (-0.10, EAVES - 0.20),
        (-0.13, EAVES - 0.13),
        (-0.22, EAVES - 0.09),
        (-0.22, EAVES - 0.05),
        (-0.27, EAVES - 0.02),
        (-0.27, EAVES + 0.05),
        (0.02, EAVES + 0.09),
    ]
    return along_x(profile, -HALF_BAY, HALF_BAY)


def upper_wall_bay(open_window):
    """Gallery wall: a window with iron bars, or the same shape as a blind recess. Face at y = 0, looks toward -y."""
    radius, sill, spring, thick = 0.72, GALLERY + 0.85, 6.05, 0.5
    deep = thick if open_window else 0.28
    caps = (True, open_window)
    wall = holed_wall(radius, sill, spring, GALLERY - 0.3, EAVES + 0.2, 0.0, deep, 'plaster', caps, True).painted(
        'plaster', WALL_TINT
    )
    skirting = [
        (0.02, GALLERY - 0.02),
        (-0.05, GALLERY - 0.02),
        (-0.05, GALLERY + 0.22),
        (-0.02, GALLERY + 0.27),
        (0.02, GALLERY + 0.27),
    ]
    parts = [
        wall,
        frame(radius, 0.15, 0.06, sill, spring, 0.0),
        sill_stone(radius, sill, 0.0),
        upper_cornice(),
        along_x(skirting, -HALF_BAY, HALF_BAY),
    ]
    if open_window:
        parts += window_bars(radius, sill, spring, 0.34, 2, 4)
    else:
        back = box((-HALF_BAY, deep, GALLERY - 0.3), (HALF_BAY, thick, EAVES + 0.2), 'plaster', NICHE_TINT)
        boss = lathe(
            [(0.30, 0.0), (0.30, 0.03), (0.25, 0.06), (0.22, 0.035), (0.16, 0.035), (0.12, 0.08), (0, 0.11)],
            16,
            'stone',
            caps=(False, False),
        ).turned('x', 90)
        parts += [back, boss.moved(0, deep, spring)]
    return join(parts)


def window_bars(radius, sill, spring, y, uprights, levels, size=0.022):
    """An iron grid in an arched opening; bars end inside the wall."""
    bars = []
    for i in range(uprights):
        x = radius * (2 * (i + 1) / (uprights + 1) - 1)
        top = spring + math.sqrt(radius**2 - x**2) + 0.02
        bars.append(box((x - size, y - size, sill - 0.02), (x + size, y + size, top), 'iron'))
    for i in range(levels):
        z = sill + (spring + radius - sill) * (i + 1) / (levels + 1)
        half = radius if z < spring else math.sqrt(radius**2 - (z - spring) ** 2)
        bars.append(
            box((-half - 0.02, y - 0.7 * size, z - 0.7 * size), (half + 0.02, y + 0.7 * size, z + 0.7 * size), 'iron')
        )
    return bars
