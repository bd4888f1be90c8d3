"""The owl: a body of revolution whose surface is carved by functions of angle and height, and its plinth; urns."""
import math
import numpy as np
from shapes import box, join, lathe, rings, solid, square_lathe

AROUND, UP = 112, 76  # the body's grid
HEIGHT = 1.20
EYE_ANGLE, EYE_V = 0.47, 0.795
OWL_TINT = (0.86, 0.66, 0.50)  # a redder stone than the plinth's


def bump(x, width):
    """A smooth hill of height 1 at 0 that ends at +-width."""
    t = np.clip(1 - np.abs(x) / width, 0, 1)
    return t * t * (3 - 2 * t)


def outline(v):
    """The owl's radius by height v in [0, 1]: belly, neck, head, crown."""
    keys = [
        (0.0, 0.20),
        (0.05, 0.235),
        (0.15, 0.285),
        (0.30, 0.325),
        (0.45, 0.325),
        (0.57, 0.285),
        (0.65, 0.252),
        (0.71, 0.258),
        (0.79, 0.278),
        (0.87, 0.258),
        (0.94, 0.19),
        (0.98, 0.11),
        (1.0, 0.0),
    ]
    xs, ys = zip(*keys)
    fine = np.linspace(0, 1, 401)
    smooth = np.convolve(np.pad(np.interp(fine, xs, ys), 10, 'edge'), np.ones(21) / 21, 'valid')
    smooth[-30:] = np.interp(fine[-30:], xs, ys)
    return np.interp(v, fine, smooth)


def feathers(angle, height, across, down, depth):
    """Rows of overlapping rounded scales: a height field that drops at each feather's lower edge."""
    row = np.floor(height / down)
    a = angle / across + 0.5 * (row % 2)
    u = (a - np.floor(a)) * 2 - 1
    v = height / down - row
    edge = 1 - 0.55 * np.sqrt(np.clip(1 - u * u, 0, 1))
    tip = np.clip((v - (edge - 0.45)) / 0.22, 0, 1)
    rib = 0.18 * bump(u, 0.16)
    return depth * (tip * (1.15 - 0.8 * v) + rib * tip)


def carve(angle, v):
    """What is added to the radius: wings, feathers, face discs. angle 0 is the front (+x)."""
    a = (angle + math.pi) % (2 * math.pi) - math.pi
    z = v * HEIGHT
    wing_line = 0.86 + 0.55 * np.clip(0.62 - v, 0, 1)
    wing = (
        np.clip((np.abs(a) - wing_line) / 0.10, 0, 1)
        * np.clip((0.64 - v) / 0.05, 0, 1)
        * np.clip((v - 0.10) / 0.05, 0, 1)
    )
    head = np.clip((v - 0.655) / 0.03, 0, 1)
    breast = feathers(a, z, 0.27, 0.078, 0.022) * (1 - wing) * (1 - head)
    coverts = feathers(a, z, 0.25, 0.095, 0.024)
    quills = 0.016 * np.abs(np.sin((np.abs(a) * 1.0 + 0.35 * v) * 13.0)) * np.clip((0.36 - v) / 0.06, 0, 1)
    pinion = np.clip((v - 0.33) / 0.05, 0, 1)
    out = breast + wing * (0.030 + coverts * pinion + quills)
    return out + head * face(a, z, v)


def face(a, z, v):
    """Two dished discs rayed like the sun; feathers on the rest of the head."""
    crown = feathers(a, z, 0.30, 0.06, 0.010) * np.clip((np.abs(a) - 0.95) / 0.15, 0, 1)
    total = crown
    eye_z = EYE_V * HEIGHT
    for side in (-1, 1):
        du, dz = (a - side * EYE_ANGLE) * 0.27, z - eye_z
        r = np.hypot(du, dz)
        around = np.arctan2(dz, du)
        dish = -0.024 * bump(r, 0.13) + 0.020 * bump(r - 0.125, 0.036)
        rays = 0.007 * np.cos(12 * around) * bump(r - 0.088, 0.034)
        total = total + (dish + rays) * np.clip((1.25 - np.abs(a)) / 0.2, 0, 1) * (side * a > -0.1)
    return total


def owl_body():
    v = np.concatenate(
        [np.linspace(0, 0.64, int(UP * 0.58), endpoint=False), np.linspace(0.64, 1.0, UP - int(UP * 0.58))]
    )
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    # the front gets more columns than the back: the face is there
    angles = angles - 0.42 * np.sin(angles)
    loops = []
    for value in v:
        r = outline(value) + (carve(angles, np.full(AROUND, value)) if 0.0 < value < 0.985 else 0.0)
        fade = np.clip((1 - value) / 0.06, 0, 1)
        r = np.where(value > 0.94, outline(value) + (r - outline(value)) * fade, r)
        lean = 0.02 * math.sin(math.pi * value)
        loops.append(
            np.stack([r * np.cos(angles) * 0.93 + lean, r * np.sin(angles), np.full(AROUND, value * HEIGHT)], -1)
        )
    return solid(rings(loops, 'stone', ends=(True, False)))


def ear(side):
    """A tuft of feathers: a bent, tapering cone set into the head."""
    loops, n = [], 10
    for t in np.linspace(0, 1, 7):
        r = 0.085 * (1 - t) ** 0.75
        centre = np.array([0.06 - 0.05 * t * t, side * (0.135 + 0.075 * t), 1.04 + 0.32 * t])
        ring = [
            (
                centre[0] + r * 0.7 * (1 + 0.14 * math.cos(5 * a)) * math.cos(a),
                centre[1] + r * math.sin(a),
                centre[2] - 0.25 * r * math.cos(a),
            )
            for a in np.linspace(0, 2 * np.pi, n + 1)[:-1]
        ]
        loops.append(ring)
    return solid(rings(loops, 'stone', ends=(True, False)))


def on_face(part, angle, v, out):
    """Sets a part, modelled along +z about the origin, on the owl's face, its +z outward."""
    r = float(outline(v)) + out
    middle = (r * math.cos(angle) * 0.93 + 0.02 * math.sin(math.pi * v), r * math.sin(angle), v * HEIGHT)
    return part.turned('y', 90).turned('z', math.degrees(angle)).moved(*middle)


def eye(side):
    """A ringed ball with a drilled pupil."""
    profile = [
        (0.066, -0.03),
        (0.066, 0.004),
        (0.058, 0.014),
        (0.049, 0.008),
        (0.047, 0.014),
        (0.040, 0.030),
        (0.028, 0.040),
        (0.019, 0.043),
        (0.016, 0.028),
        (0.0, 0.026),
    ]
    return on_face(lathe(profile, 20, 'stone', caps=(False, False)), side * EYE_ANGLE, EYE_V, -0.002)


def brow(side):
    """A heavy brow from the beak's root over the eye to the ear, thickest in its middle."""
    loops = []
    for t in np.linspace(0, 1, 9):
        angle, v = side * (0.10 + 0.72 * t), EYE_V + 0.028 + 0.075 * t**1.3
        r = float(outline(v)) + 0.004
        middle = np.array([r * math.cos(angle) * 0.93 + 0.012, r * math.sin(angle), v * HEIGHT])
        out = np.array([math.cos(angle), math.sin(angle), 0.0])
        thick = 0.006 + 0.026 * math.sin(math.pi * (0.12 + 0.8 * t))
        loops.append(
            [
                middle + out * thick * 1.3 * math.cos(a) + np.array([0, 0, 0.75 * thick * math.sin(a)])
                for a in np.linspace(0, 2 * np.pi, 9)[:-1]
            ]
        )
    return solid(rings(loops, 'stone', ends=(True, True)))


def beak():
    """A hooked beak: sections that narrow downward and bend back to the chin."""
    loops = []
    for t in np.linspace(0, 1, 8):
        half, out = 0.046 * (1 - t) ** 0.7, 0.03 + 0.075 * math.sin(math.pi * min(1.0, 0.25 + 0.68 * t)) - 0.03 * t
        z = EYE_V * HEIGHT + 0.035 - 0.155 * t
        front = float(outline(z / HEIGHT)) * 0.93 + 0.012
        loops.append(
            [
                (
                    front - 0.04 + (0.04 + out) * max(0.0, math.cos(a)) ** 0.8 * (1 if t < 1 else 0),
                    half * math.sin(a),
                    z,
                )
                for a in np.linspace(-np.pi / 2, np.pi / 2, 9)
            ]
        )
    return solid(rings(loops, 'stone', ends=(True, False)))


def toe(x, y, heading, length):
    """A knuckled toe with a claw, on z = 0, along +x before it is turned."""
    loops = []
    for t in np.linspace(0, 1, 9):
        r = (0.034 + 0.007 * math.cos(t * 3 * 2 * math.pi)) * (1 - 0.75 * max(0.0, t - 0.7) / 0.3) if t < 1 else 0.0
        loops.append(
            [
                (length * t, r * math.cos(a), max(-0.02, 0.030 * (1 - 0.7 * t) + r * math.sin(a)))
                for a in np.linspace(0, 2 * np.pi, 9)[:-1]
            ]
        )
    out = solid(rings(loops, 'stone', ends=(True, False)))
    return out.turned('z', heading).moved(x, y, 0.02)


def owl():
    """The owl on its round base; faces +x, stands on z = 0."""
    base = lathe(
        [
            (0.0, 0.0),
            (0.35, 0.0),
            (0.36, 0.012),
            (0.36, 0.05),
            (0.345, 0.065),
            (0.33, 0.07),
            (0.33, 0.085),
            (0.0, 0.085),
        ],
        40,
        'stone',
    )
    lift = 0.10
    parts = [base, owl_body().moved(0, 0, lift), ear(1).moved(0, 0, lift), ear(-1).moved(0, 0, lift)]
    for side in (-1, 1):
        parts += [
            toe(0.16, side * 0.105, heading, 0.15).moved(0, 0, 0.075)
            for heading in (-22 + 6 * side, 6 * side, 22 + 6 * side)
        ]
    parts += [p.moved(0, 0, lift) for p in [beak(), eye(1), eye(-1), brow(1), brow(-1)]]
    return join(parts).painted('stone', OWL_TINT)


def plinth():
    """A square pedestal with mouldings and sunk panels, 0.86 m high."""
    body = square_lathe(
        [
            (0.46, 0.0),
            (0.46, 0.10),
            (0.435, 0.125),
            (0.42, 0.16),
            (0.375, 0.19),
            (0.365, 0.22),
            (0.365, 0.66),
            (0.385, 0.68),
            (0.385, 0.71),
            (0.42, 0.76),
            (0.45, 0.78),
            (0.45, 0.84),
            (0.435, 0.855),
            (0.435, 0.86),
        ],
        'stone',
    )
    frames = []
    for turn in range(4):
        for lo, hi in (
            ((-0.28, -0.378, 0.27), (0.28, -0.36, 0.31)),
            ((-0.28, -0.378, 0.57), (0.28, -0.36, 0.61)),
            ((-0.28, -0.378, 0.31), (-0.24, -0.36, 0.57)),
            ((0.24, -0.378, 0.31), (0.28, -0.36, 0.57)),
        ):
            frames.append(box(lo, hi, 'stone', bevel=0.006).turned('z', 90 * turn))
        boss = lathe(
            [(0.09, -0.01), (0.09, 0.008), (0.06, 0.02), (0.03, 0.012), (0.0, 0.022)],
            16,
            'stone',
            shape=lambda a, r, z: r * (1 + 0.12 * math.cos(8 * a)) if r > 0.05 else r,
            caps=(False, False),
        )
        frames.append(boss.turned('x', 90).moved(0, -0.365, 0.44).turned('z', 90 * turn))
    return join([body] + frames)


def urn():
    """A fluted urn for the niches, 0.78 m high."""

    def flutes(angle, r, z):
        low = max(0.0, 1 - abs(z - 0.30) / 0.12)
        frieze = 1.0 if 0.45 < z < 0.56 else 0.0
        return r * (1 + 0.05 * low * abs(math.cos(6 * angle)) + 0.03 * frieze * math.cos(12 * angle))

    profile = [
        (0.0, 0.0),
        (0.15, 0.0),
        (0.16, 0.015),
        (0.155, 0.04),
        (0.09, 0.07),
        (0.06, 0.12),
        (0.075, 0.15),
        (0.10, 0.205),
        (0.18, 0.25),
        (0.225, 0.31),
        (0.245, 0.38),
        (0.245, 0.43),
        (0.232, 0.45),
        (0.24, 0.50),
        (0.235, 0.55),
        (0.21, 0.57),
        (0.16, 0.60),
        (0.14, 0.64),
        (0.16, 0.69),
        (0.205, 0.72),
        (0.21, 0.74),
        (0.19, 0.745),
        (0.13, 0.66),
        (0.0, 0.60),
    ]
    return lathe(profile, 24, 'stone', shape=flutes)
