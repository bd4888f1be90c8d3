"""Things that can be moved: crates, drums, barrels, sacks, lanterns. Every part stands on z = 0 at the origin."""
import math
import random
import numpy as np
from shapes import box, cylinder, join, lathe, prism, solid, tube


# ---- crates ----


def crate(size_x, size_y, size_z, seed, braces=True):
    """Boards between twelve edge beams, a brace across each side. Its hull is an exact box."""
    rng = random.Random(seed)
    beam, inset, thick = 0.055, 0.016, 0.02
    hx, hy = size_x / 2, size_y / 2
    parts = [
        box(
            (sx * hx - (beam if sx > 0 else 0), sy * hy - (beam if sy > 0 else 0), 0),
            (sx * hx + (0 if sx > 0 else beam), sy * hy + (0 if sy > 0 else beam), size_z),
            'wood',
            shade(rng, 0.85),
            grain=True,
        )
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    for end in (0, 1):
        z0 = end * (size_z - beam)
        for s in (-1, 1):
            y0 = s * hy - (beam if s > 0 else 0)
            x0 = s * hx - (beam if s > 0 else 0)
            parts.append(
                box((-hx + beam, y0, z0), (hx - beam, y0 + beam, z0 + beam), 'wood', shade(rng, 0.85), grain=True)
            )
            parts.append(
                box((x0, -hy + beam, z0), (x0 + beam, hy - beam, z0 + beam), 'wood', shade(rng, 0.85), grain=True)
            )
    half = (hx - inset, hy - inset, size_z / 2 - inset)
    lid = (hx - beam - 0.001, hy - beam - 0.001, size_z / 2)  # between the beams and flush: things stand on it
    for axis in range(3):
        for side in (-1, 1):
            parts += crate_side(axis, side, lid if axis == 2 else half, thick, size_z / 2, rng)
    if braces:
        parts += crate_braces(hx, hy, size_z, beam, rng)
    return join(parts)


def shade(rng, base):
    """A board's tint: lighter or darker, a little redder or yellower."""
    v = base * rng.uniform(0.82, 1.12)
    warm = rng.uniform(-0.05, 0.05)
    return (min(1.0, v * (1 + warm)), min(1.0, v), min(1.0, v * (1 - warm)))


def crate_side(axis, side, half, thick, middle_z, rng):
    """The boards of one side: along the longer direction of x and y, or upright on none."""
    u, v = [a for a in range(3) if a != axis]
    if axis == 2 and half[1] > half[0]:
        u, v = v, u
    count = max(3, round(2 * half[v] / 0.13))
    boards = []
    for i in range(count):
        lo, hi = np.zeros(3), np.zeros(3)
        lo[axis], hi[axis] = sorted((side * half[axis], side * (half[axis] - thick)))
        lo[u], hi[u] = -half[u] + 0.001, half[u] - 0.001
        lo[v] = -half[v] + 2 * half[v] * i / count + 0.003
        hi[v] = -half[v] + 2 * half[v] * (i + 1) / count - 0.003
        lo[2] += middle_z
        hi[2] += middle_z
        board = box(lo, hi, 'wood', shade(rng, 0.97), grain=True)
        shift = rng.random(), rng.random()
        board.uvs = [[(a + shift[0], b + shift[1]) for a, b in uv] for uv in board.uvs]
        boards.append(board)
    return boards


def crate_braces(hx, hy, size_z, beam, rng):
    """A slanting board on each upright side, flush with the beams."""
    out = []
    for axis, length, face in (('y', hx, hy), ('x', hy, hx)):
        run, rise = 2 * (length - beam), size_z - 2 * beam
        w = 0.045
        c = w / math.hypot(run, rise)
        dx, dz = c * rise, c * run
        outline = [
            (-run / 2, beam),
            (-run / 2 + 2 * dx, beam),
            (run / 2, size_z - beam - 2 * dz),
            (run / 2, size_z - beam),
            (run / 2 - 2 * dx, size_z - beam),
            (-run / 2, beam + 2 * dz),
        ]
        for side in (-1, 1):
            lo, hi = sorted((side * (face - 0.004), side * (face - 0.022)))
            out.append(prism(outline, lo, hi, 'wood', shade(rng, 0.9), axis=axis))
    return out


# ---- steel ----

DRUM_RADIUS, DRUM_HEIGHT = 0.29, 0.88


def drum(material):
    """A 200 l drum: chimes, two rolling hoops, corrugations, sunk lid and bottom, bungs."""
    r = DRUM_RADIUS
    side = [(0.0, 0.018), (r - 0.030, 0.018), (r - 0.020, 0.0), (r - 0.002, 0.0), (r, 0.010), (r - 0.012, 0.024)]
    for z in (0.295, 0.585):
        side += [(r - 0.012, z - 0.022), (r, z - 0.006), (r, z + 0.006), (r - 0.012, z + 0.022)]
    h = DRUM_HEIGHT
    side += [
        (r - 0.012, h - 0.024),
        (r, h - 0.010),
        (r - 0.002, h),
        (r - 0.020, h),
        (r - 0.030, h - 0.02),
        (0, h - 0.016),
    ]
    body = lathe(side, 22, material)
    bung = cylinder(0.033, h - 0.025, h - 0.004, 8, 'iron')
    return join([body, bung.moved(0.19, 0, 0), cylinder(0.02, h - 0.025, h - 0.006, 8, 'iron').moved(-0.19, 0.03, 0)])


def bucket():
    """Open, with thickness, a rolled rim and a bail lying on the rim."""
    profile = [
        (0.0, 0.012),
        (0.105, 0.012),
        (0.108, 0.0),
        (0.116, 0.0),
        (0.122, 0.02),
        (0.158, 0.27),
        (0.166, 0.277),
        (0.166, 0.287),
        (0.156, 0.29),
        (0.150, 0.28),
        (0.117, 0.03),
        (0.0, 0.028),
    ]
    bail = [(0.17 * math.cos(t), 0.16 * math.sin(t), 0.294 + 0.004 * math.sin(t)) for t in np.linspace(0, math.pi, 13)]
    ears = [box((s * 0.168 - 0.012, -0.02, 0.255), (s * 0.168 + 0.012, 0.02, 0.30), 'iron') for s in (-1, 1)]
    return join([lathe(profile, 18, 'iron'), tube(bail, 0.005, 5, 'iron')] + ears)


def chain(links, seed):
    """Links of bent rod laid along a winding line, tilted one way and the other; each lies on the floor."""
    rng = random.Random(seed)
    parts, x, y, heading = [], 0.0, 0.0, 0.0
    for i in range(links):
        link = chain_link()
        link = link.turned('x', 38 if i % 2 else -38)
        link = link.moved(0, 0, -float(link.points[:, 2].min()))
        parts.append(link.turned('z', math.degrees(heading)).moved(x, y, 0))
        heading += rng.uniform(-0.1, 0.3)
        x, y = x + 0.078 * math.cos(heading), y + 0.078 * math.sin(heading)
    return join(parts)


def chain_link():
    half, bend, rod = 0.026, 0.026, 0.0085
    ends = [(half + bend * math.cos(t), bend * math.sin(t), 0) for t in np.linspace(-math.pi / 2, math.pi / 2, 4)]
    ends += [(-half - bend * math.cos(t), -bend * math.sin(t), 0) for t in np.linspace(-math.pi / 2, math.pi / 2, 4)]
    return tube(ends, rod, 5, 'iron', closed=True)


# ---- wood and cloth ----


def barrel():
    """Staves with a belly, sunk heads, four hoops."""
    staves, height, low, belly = 18, 0.92, 0.255, 0.335
    radius = lambda z: low + (belly - low) * (1 - ((z - height / 2) / (height / 2)) ** 2)
    zs = np.linspace(0, height, 7)
    profile = [(0.0, 0.035), (low - 0.02, 0.035), (low - 0.02, 0.0)] + [(radius(z), z) for z in zs]
    profile += [(low - 0.02, height), (low - 0.02, height - 0.035), (0.0, height - 0.035)]
    body = lathe(profile, staves, 'wood')
    rng = random.Random(3)
    tints = [shade(rng, 0.8) for _ in range(staves)]
    body.uvs = [[(v, u) for u, v in uv] for uv in body.uvs]
    body.tints = [tints[i % staves] for i in range(len(body.faces))]
    hoops = []
    for z0, z1 in ((0.015, 0.07), (0.22, 0.265), (0.655, 0.70), (0.85, 0.905)):
        hoops.append(
            solid(
                lathe(
                    [
                        (radius(z0) - 0.01, z0),
                        (radius(z0) + 0.005, z0),
                        (radius(z1) + 0.005, z1),
                        (radius(z1) - 0.01, z1),
                    ],
                    staves,
                    'iron',
                    (0.75, 0.7, 0.66),
                    caps=(False, False),
                )
            )
        )
    return join([body] + hoops)


def bench():
    """A plank bench on two trestles."""
    rng = random.Random(11)
    parts = [
        box((-0.9, y0, 0.43), (0.9, y0 + 0.17, 0.47), 'wood', shade(rng, 0.8), 0.006, True) for y0 in (-0.175, 0.005)
    ]
    for x in (-0.68, 0.68):
        parts.append(box((x - 0.03, -0.16, 0.37), (x + 0.03, 0.16, 0.43), 'wood', shade(rng, 0.7), 0.006, True))
        for y in (-0.13, 0.13):
            parts.append(
                box((x - 0.028, y - 0.028, 0), (x + 0.028, y + 0.028, 0.37), 'wood', shade(rng, 0.7), 0.006, True)
            )
    parts.append(box((-0.65, -0.02, 0.16), (0.65, 0.02, 0.22), 'wood', shade(rng, 0.7), 0.006, True))
    return join(parts)


def sack(seed):
    """A full sack: a slumped bag with a flat bottom, folds, and a tied neck."""
    rng = random.Random(seed)
    waves = [(rng.choice((3, 4, 5, 7)), rng.uniform(0, 6.28), rng.uniform(0.01, 0.022)) for _ in range(4)]

    def folds(angle, r, z):
        squash = 1 + 0.16 * math.cos(2 * angle + waves[0][1])
        wobble = sum(a * math.sin(k * angle + p + 7 * z) for k, p, a in waves)
        neck = 0.09 * math.cos(9 * angle) if z > 0.52 else 0.0
        return r * (squash + (wobble if z > 0.02 else 0) + neck)

    profile = [
        (0.0, 0.0),
        (0.21, 0.0),
        (0.25, 0.03),
        (0.275, 0.10),
        (0.285, 0.18),
        (0.275, 0.27),
        (0.245, 0.37),
        (0.19, 0.46),
        (0.11, 0.525),
        (0.055, 0.555),
        (0.06, 0.575),
        (0.10, 0.62),
        (0.11, 0.645),
        (0.07, 0.635),
        (0.0, 0.60),
    ]
    bag = lathe(profile, 22, 'cloth', shape=folds)
    rope = lathe(
        [(0.05, 0.55), (0.07, 0.552), (0.074, 0.562), (0.07, 0.572), (0.05, 0.574)], 12, 'cloth', (0.6, 0.5, 0.4)
    )
    return join([bag, rope])


def book(width, depth, thick, tint):
    """A closed book lying flat: boards, a rounded spine, pages set back."""
    board = 0.004
    cover = [
        box((-width / 2, -depth / 2, z), (width / 2, depth / 2, z + board), 'leather', tint)
        for z in (0.0, thick - board)
    ]
    pages = box(
        (-width / 2 + 0.004, -depth / 2 + 0.005, board), (width / 2 - 0.006, depth / 2 - 0.005, thick - board), 'paper'
    )
    spine = [
        (-width / 2 - 0.008 * math.sin(t), thick / 2 - (thick / 2) * math.cos(t)) for t in np.linspace(0, math.pi, 7)
    ]
    back = prism(
        spine + [(-width / 2 + 0.003, thick), (-width / 2 + 0.003, 0.0)], -depth / 2, depth / 2, 'leather', tint
    )
    return join(cover + [pages, back])


# ---- lantern ----

LANTERN_FLAME = 0.17


def lantern():
    """A brass storm lantern about a glowing core; the light stands at LANTERN_FLAME above its foot."""
    foot = lathe([(0.0, 0.0), (0.09, 0.0), (0.10, 0.008), (0.10, 0.03), (0.08, 0.05), (0.0, 0.05)], 12, 'brass')
    core = lathe([(0.0, 0.06), (0.04, 0.07), (0.055, 0.12), (0.055, 0.22), (0.0, 0.28)], 10, 'glow')
    burner = lathe([(0.0, 0.045), (0.03, 0.045), (0.03, 0.068), (0.0, 0.068)], 12, 'brass')
    bars = [
        box((-0.006, -0.006, 0.04), (0.006, 0.006, 0.30), 'brass').moved(0.085, 0, 0).turned('z', 90 * i)
        for i in range(4)
    ]
    hoops = [
        solid(
            lathe(
                [(0.08, z), (0.094, z), (0.094, z + 0.012), (0.08, z + 0.012), (0.08, z)],
                12,
                'brass',
                caps=(False, False),
            )
        )
        for z in (0.165,)
    ]
    cap = lathe(
        [
            (0.0, 0.292),
            (0.10, 0.292),
            (0.104, 0.302),
            (0.05, 0.36),
            (0.035, 0.385),
            (0.05, 0.39),
            (0.03, 0.41),
            (0.0, 0.415),
        ],
        12,
        'brass',
    )
    grip = tube(
        [(0.055 * math.cos(t), 0, 0.41 + 0.055 * math.sin(t)) for t in np.linspace(0, math.pi, 7)], 0.006, 5, 'brass'
    )
    return join([foot, core, burner, cap, grip] + bars + hoops)
