"""The coffered vault: one bay of it, open to the sky or closed, and its transverse arches."""

import math
import numpy as np
from plan import BAY, WALL_Y, VAULT_RADIUS, VAULT_CENTRE
from shapes import WHITE, join, lathe, make, rings, sweep

HALF_BAY = BAY / 2
COFFER_TINT = (0.55, 0.74, 0.78)  # faded blue in the panels


def vault_point(angle, x, lift):
    r = VAULT_RADIUS + lift
    return (x, r * math.sin(angle), VAULT_CENTRE + r * math.cos(angle))


def coffer_loop(x0, x1, a0, a1, lift, steps=2):
    """A rectangle on the vault, seen from above counter-clockwise; its curved sides in `steps` chords."""
    up = [(x0, a) for a in np.linspace(a0, a1, steps + 1)]
    back = [(x1, a) for a in np.linspace(a1, a0, steps + 1)]
    return [vault_point(a, x, lift) for x, a in up + back]


def coffer(x0, x1, a0, a1, is_open):
    """One coffer: a flat frame, two sunk steps and a panel, or an opening to the sky with a cover around it."""
    da = lambda metres: metres / VAULT_RADIUS
    levels = [(0.0, 0.0), (0.20, 0.0), (0.22, 0.16), (0.38, 0.16), (0.40, 0.32)]
    if is_open:
        levels = levels[:3] + [(0.38, 0.16), (0.38, 0.50)]
    loops = [coffer_loop(x0 + d, x1 - d, a0 + da(d), a1 - da(d), lift) for d, lift in levels]
    inside = rings(loops, 'plaster')
    d = levels[-1][0]
    cover = [coffer_loop(x0, x1, a0, a1, 0.50)]
    if is_open:
        cover.append(coffer_loop(x0 + d, x1 - d, a0 + da(d), a1 - da(d), 0.50))
        return join([inside, rings(cover, 'stone').flipped()])
    return join(
        [
            inside,
            panel(x0 + d, x1 - d, a0 + da(d), a1 - da(d), 0.32, 2, COFFER_TINT),
            panel(x0, x1, a0, a1, 0.50).flipped(),
            rosette(x0, x1, a0, a1),
        ]
    )


def panel(x0, x1, a0, a1, lift, steps=2, tint=WHITE):
    angles = np.linspace(a0, a1, steps + 1)
    points = [vault_point(a, x, lift) for a in angles for x in (x0, x1)]
    return make(points, [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(steps)], 'plaster', tint)


def rosette(x0, x1, a0, a1):
    """A boss in the coffer's middle."""
    middle = (a0 + a1) / 2
    petals = lambda angle, r, z: r * (1 + 0.13 * math.cos(5 * angle)) if r > 0.09 else r
    boss = lathe(
        [(0.21, -0.02), (0.22, 0.03), (0.08, 0.05), (0.0, 0.115)], 10, 'brass', shape=petals, caps=(False, False)
    )
    boss = boss.turned('x', 180).turned('x', -math.degrees(middle))
    return boss.moved(*vault_point(middle, (x0 + x1) / 2, 0.31))


def vault_bay(is_open):
    """Coffers over one bay, seven across and two along. With is_open, the middle ones let the sun in."""
    reach = math.asin(WALL_Y / VAULT_RADIUS) + 0.01
    edges = np.linspace(-reach, reach, 8)
    cells = []
    for x0, x1 in ((-HALF_BAY + 0.12, 0.0), (0.0, HALF_BAY - 0.12)):
        for i in range(7):
            cells.append(coffer(x0, x1, edges[i], edges[i + 1], is_open and i == 3))
    for x0, x1 in ((-HALF_BAY, -HALF_BAY + 0.12), (HALF_BAY - 0.12, HALF_BAY)):
        cells += [panel(x0, x1, -reach, reach, 0.0, 14), panel(x0, x1, -reach, reach, 0.50, 14).flipped()]
    return join(cells)


def vault_rib():
    """A transverse arch under the vault, over each pair of pilasters. Origin on the hall's axis."""
    reach = math.asin((WALL_Y + 0.05) / VAULT_RADIUS)
    profile = [
        (0.22, 0.04),
        (0.22, -0.08),
        (0.17, -0.12),
        (0.17, -0.22),
        (0.12, -0.26),
        (-0.12, -0.26),
        (-0.17, -0.22),
        (-0.17, -0.12),
        (-0.22, -0.08),
        (-0.22, 0.04),
    ]
    frames = [
        (vault_point(a, 0.0, 0.0), (1, 0, 0), (0, math.sin(a), math.cos(a))) for a in np.linspace(-reach, reach, 17)
    ]
    return sweep(profile, frames, 'stone')
