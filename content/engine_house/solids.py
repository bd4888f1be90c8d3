"""What several parts need beyond hall/shapes.py: lathes in several materials, flat textures on discs, bolts, balls."""
import math
import numpy as np
from shapes import box_uv, face_normal, lathe, solid

METALS = ('iron', 'wrought', 'brass', 'bronze', 'red')
METAL_REPEAT = 0.25  # metres that a metal's picture covers here: half of the hall's, for small things
FLAT = 0.8  # of a face's normal along z: from here on it is textured from above


def from_above(part):
    """The same part; faces that look up or down are textured by x and y, so that discs show no pole."""
    out = part.moved()
    for i, face in enumerate(out.faces):
        corners = out.points[list(face)]
        normal = face_normal(corners)
        if abs(normal[2]) > FLAT * np.linalg.norm(normal):
            out.uvs[i] = box_uv(corners)
    return out


def turned_solid(profile, segments, material, tint=(1.0, 1.0, 1.0)):
    """A closed lathe of (radius, z): a profile that does not begin and end on the axis is a ring and is closed."""
    is_ring = profile[0][0] > 0 and profile[-1][0] > 0
    whole = list(profile) + [profile[0]] if is_ring else list(profile)
    out = solid(lathe(whole, segments, material, tint, caps=(False, False)))
    return seamless(out) if material in METALS else from_above(out)


def seamless(part):
    """The same lathe with whole repeats of a metal's picture around it: its scratches run as a turner leaves them."""
    length = max(u for uv in part.uvs for u, _ in uv)
    scale = max(1, round(length / METAL_REPEAT)) * METAL_REPEAT / length
    out = part.moved()
    out.uvs = [[(u * scale, v) for u, v in uv] for uv in part.uvs]
    return out


def ball(radius, segments, rows, material, tint=(1.0, 1.0, 1.0)):
    angles = [math.pi * (i / rows - 0.5) for i in range(rows + 1)]
    profile = [(max(0.0, radius * math.cos(a)), radius * math.sin(a)) for a in angles]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return solid(lathe(profile, segments, material, tint, caps=(False, False)))


def bolt(radius, height):
    """A six-sided iron head on z = 0 that reaches 1 cm below it, into what it holds."""
    return lathe([(radius, -0.01), (radius, height)], 6, 'iron')
