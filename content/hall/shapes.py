"""Solids made of polygons, without Blender: a Part is vertices and faces, with texture coordinates in metres.

Units are metres, Z is up, faces are counter-clockwise seen from outside. Every function returns a new Part.
"""
import math
import numpy as np

WHITE = (1.0, 1.0, 1.0)


class Part:
    """A polygon soup with a material name, a tint and texture coordinates for every face."""

    def __init__(self):
        self.points = np.zeros((0, 3))
        self.faces, self.uvs, self.materials, self.tints = [], [], [], []

    def moved(self, x=0.0, y=0.0, z=0.0):
        return self._with_points(self.points + np.array([x, y, z]))

    def turned(self, axis, degrees):
        return self._with_points(self.points @ rotation(axis, degrees).T)

    def stretched(self, x, y, z):
        out = self._with_points(self.points * np.array([x, y, z]))
        return out.flipped() if x * y * z < 0 else out

    def flipped(self):
        out = self._with_points(self.points)
        out.faces = [f[::-1] for f in self.faces]
        out.uvs = [u[::-1] for u in self.uvs]
        return out

    def painted(self, material, tint=WHITE):
        out = self._with_points(self.points)
        out.materials = [material] * len(self.faces)
        out.tints = [tint] * len(self.faces)
        return out

    def _with_points(self, points):
        out = Part()
        out.points = points.copy()
        out.faces, out.uvs = list(self.faces), list(self.uvs)
        out.materials, out.tints = list(self.materials), list(self.tints)
        return out


def rotation(axis, degrees):
    """The 3 x 3 matrix of a turn about 'x', 'y' or 'z'."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array(
        {
            'x': [[1, 0, 0], [0, c, -s], [0, s, c]],
            'y': [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            'z': [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis],
        float,
    )


def join(parts):
    """All parts in one."""
    out, base = Part(), 0
    for p in parts:
        out.faces += [tuple(i + base for i in f) for f in p.faces]
        out.uvs += p.uvs
        out.materials += p.materials
        out.tints += p.tints
        base += len(p.points)
    if parts:
        out.points = np.concatenate([p.points for p in parts])
    return out


def make(points, faces, material='stone', tint=WHITE, uvs=None):
    """A part from raw data; texture coordinates are box-projected unless given."""
    out = Part()
    out.points = np.asarray(points, float).reshape(-1, 3)
    out.faces = [tuple(f) for f in faces]
    out.uvs = uvs if uvs is not None else [box_uv(out.points[list(f)]) for f in out.faces]
    out.materials = [material] * len(out.faces)
    out.tints = [tint] * len(out.faces)
    return out


def solid(part):
    """The same closed part with its faces turned outward (by the sign of its volume)."""
    p, volume = part.points, 0.0
    for f in part.faces:
        for k in range(1, len(f) - 1):
            volume += np.dot(p[f[0]], np.cross(p[f[k]], p[f[k + 1]]))
    return part if volume > 0 else part.flipped()


def face_normal(corners):
    """Newell's normal, not normalised: right for concave polygons too."""
    following = np.roll(corners, -1, axis=0)
    d, s = corners - following, corners + following
    return np.array([np.sum(d[:, 1] * s[:, 2]), np.sum(d[:, 2] * s[:, 0]), np.sum(d[:, 0] * s[:, 1])])


def box_uv(corners):
    """World-scale projection along the axis that the face looks along most; v is up on walls."""
    axis = int(np.argmax(np.abs(face_normal(corners)) + np.array([2e-6, 1e-6, 0.0])))
    u, v = [(1, 2), (0, 2), (0, 1)][axis]
    return [(float(c[u]), float(c[v])) for c in corners]


# ---- boxes and prisms ----


def box(lo, hi, material='stone', tint=WHITE, bevel=0.0, grain=False):
    """A box, its edges cut off by `bevel`. With `grain`, u runs along the longest side (wood)."""
    lo, hi = np.array(lo, float), np.array(hi, float)
    out = bevelled_box(lo, hi, bevel) if bevel > 0 else plain_box(lo, hi)
    if grain:
        out.uvs = [grain_uv(out.points[list(f)], int(np.argmax(hi - lo))) for f in out.faces]
    return out.painted(material, tint)


def plain_box(lo, hi):
    points = [[(lo, hi)[i][0], (lo, hi)[j][1], (lo, hi)[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    return make(points, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def bevelled_box(lo, hi, bevel):
    """24 vertices: each corner has one on each of its three faces."""
    points, index = [], {}
    for corner in [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]:
        for axis in range(3):
            p = [(lo, hi)[corner[a]][a] + (0 if a == axis else (bevel, -bevel)[corner[a]]) for a in range(3)]
            index[corner, axis] = len(points)
            points.append(p)
    faces = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
        for side in (0, 1):
            faces.append([index[corner_of(axis, side, b, i, c, j), axis] for i, j in ring])
        for i, j in ring:  # the bevel along `axis` between the faces that look along b and c
            ends = [corner_of(axis, s, b, i, c, j) for s in (0, 1)]
            faces.append([index[ends[0], b], index[ends[1], b], index[ends[1], c], index[ends[0], c]])
    for corner in [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]:
        faces.append([index[corner, a] for a in range(3)])
    return outward_convex(points, faces)


def corner_of(axis, side, b, i, c, j):
    out = [0, 0, 0]
    out[axis], out[b], out[c] = side, i, j
    return tuple(out)


def outward_convex(points, faces):
    """Turns each face of a convex body away from the body's middle."""
    points = np.asarray(points, float)
    middle, turned = points.mean(axis=0), []
    for f in faces:
        corners = points[list(f)]
        turned.append(f if np.dot(face_normal(corners), corners.mean(axis=0) - middle) > 0 else f[::-1])
    return make(points, turned)


def grain_uv(corners, along):
    """u along axis `along`, v across it on the face."""
    normal = np.abs(face_normal(corners))
    normal[along] = -1 if normal[along] < 0.9 * np.linalg.norm(normal) else normal[along]
    look = int(np.argmax(normal))
    u = along if along != look else (along + 1) % 3
    v = 3 - u - look
    return [(float(c[u]), float(c[v])) for c in corners]


def prism(polygon, lo, hi, material='stone', tint=WHITE, axis='y', skip=(), caps=(True, True)):
    """Sweeps a flat polygon from lo to hi along the axis; it is (x, z) for axis 'y', (y, z) for 'x', (x, y) for 'z'.

    skip: numbers of the polygon's edges that get no wall (they meet a neighbour). caps: at lo, at hi.
    """
    polygon = [tuple(p) for p in polygon]
    n = len(polygon)
    area = sum(polygon[i][0] * polygon[(i + 1) % n][1] - polygon[(i + 1) % n][0] * polygon[i][1] for i in range(n))
    place = {'x': lambda p, t: (t, p[0], p[1]), 'y': lambda p, t: (p[0], t, p[1]), 'z': lambda p, t: (p[0], p[1], t)}[
        axis
    ]
    points = [place(p, lo) for p in polygon] + [place(p, hi) for p in polygon]
    faces = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n) if i not in skip]
    faces += [tuple(range(n))[::-1]] if caps[0] else []
    faces += [tuple(range(n, 2 * n))] if caps[1] else []
    out = make(points, faces, material, tint)
    return out if (area > 0) == (axis != 'y') else out.flipped()


# ---- surfaces of rings ----


def rings(loops, material='stone', tint=WHITE, around=True, ends=(False, False), uvs=None):
    """Skins loops of equally many points. A loop of one repeated point becomes a pole. ends: close first, last."""
    loops = [np.asarray(l, float) for l in loops]
    n, points, index = len(loops[0]), [], []
    for l in loops:
        pole = np.allclose(l, l[0], atol=1e-9)
        index.append([len(points)] * n if pole else list(range(len(points), len(points) + n)))
        points += [l[0]] if pole else list(l)
    faces, face_uvs = [], []
    for r in range(len(loops) - 1):
        for i in range(n if around else n - 1):
            k = (i + 1) % n
            corners = [(r, i, i), (r, k, i + 1), (r + 1, k, i + 1), (r + 1, i, i)]
            face, uv = clean_face([(index[a][b], uvs(a, c) if uvs else None) for a, b, c in corners])
            if len(face) > 2:
                faces.append(face)
                face_uvs.append(uv)
    for end, which in ((ends[0], 0), (ends[1], -1)):
        if end and index[which][0] != index[which][1]:
            cap = tuple(index[which][::-1] if which == 0 else index[which])
            faces.append(cap)
            face_uvs.append(box_uv(np.array([points[i] for i in cap])))
    return make(points, faces, material, tint, face_uvs if uvs else None)


def clean_face(corners):
    """Drops corners that repeat the one before."""
    kept = [c for i, c in enumerate(corners) if c[0] != corners[i - 1][0]]
    return tuple(c[0] for c in kept), [c[1] for c in kept]


def lathe(profile, segments=24, material='stone', tint=WHITE, shape=None, phase=0.0, caps=(True, True)):
    """Turns a profile of (radius, z), bottom to top outside, about Z; shape(angle, radius, z) gives a carved radius."""
    angles = [2 * math.pi * (i + phase) / segments for i in range(segments)]
    radius = shape or (lambda angle, r, z: r)
    loops = [
        [(radius(a, r, z) * math.cos(a), radius(a, r, z) * math.sin(a), z) if r > 0 else (0, 0, z) for a in angles]
        for r, z in profile
    ]
    lengths = np.concatenate([[0], np.cumsum([math.dist(a, b) for a, b in zip(profile, profile[1:])])])
    round_length = 2 * math.pi * max(r for r, _ in profile)
    uvs = lambda ring, i: (round_length * i / segments, float(lengths[ring]))
    return rings(loops, material, tint, ends=caps, uvs=uvs)


def square_lathe(profile, material='stone', tint=WHITE, caps=(True, True)):
    """Like lathe for a square plan: profile of (half width, z)."""
    loops = [[(-r, -r, z), (r, -r, z), (r, r, z), (-r, r, z)] for r, z in profile]
    return rings(loops, material, tint, ends=caps)


def sweep(profile, frames, material='stone', tint=WHITE, closed=False):
    """Carries a closed profile of (a, b) along frames (origin, axis of a, axis of b); closed: the way is a ring."""
    loops = [[np.array(o) + a * np.array(ex) + b * np.array(ey) for a, b in profile] for o, ex, ey in frames]
    girth = np.concatenate(
        [[0], np.cumsum([math.dist(profile[i], profile[(i + 1) % len(profile)]) for i in range(len(profile))])]
    )
    if closed:
        loops.append(loops[0])
    way = np.concatenate(
        [[0], np.cumsum([np.linalg.norm(np.mean(b, 0) - np.mean(a, 0)) for a, b in zip(loops, loops[1:])])]
    )
    out = rings(loops, material, tint, ends=(not closed, not closed), uvs=lambda r, i: (float(way[r]), float(girth[i])))
    return solid(welded(out) if closed else out)


def welded(part):
    """Points that lie at one place become one."""
    seen, where, points = {}, [], []
    for p in part.points:
        key = tuple(np.round(p, 6))
        if key not in seen:
            seen[key] = len(points)
            points.append(p)
        where.append(seen[key])
    out = part._with_points(np.array(points))
    out.faces = [tuple(where[i] for i in f) for f in part.faces]
    return out


def arc_frames(radius, start, stop, count, centre=(0.0, 0.0), y=0.0, outward=1.0):
    """Frames along a circle in the x-z plane: a is away from the centre, b is along y times `outward`."""
    out = []
    for t in np.linspace(start, stop, count):
        c, s = math.cos(t), math.sin(t)
        out.append(((centre[0] + radius * c, y, centre[1] + radius * s), (c, 0, s), (0, outward, 0)))
    return out


def line_frames(a, b, up=(0, 0, 1)):
    """Two frames of a straight sweep from a to b: the profile's first axis is to the right, the second is `up`."""
    along = np.array(b, float) - np.array(a, float)
    right = np.cross(along, np.array(up, float))
    right /= np.linalg.norm(right)
    return [(a, right, up), (b, right, up)]


def circle(radius, count, phase=0.5):
    return [
        (radius * math.cos(2 * math.pi * (i + phase) / count), radius * math.sin(2 * math.pi * (i + phase) / count))
        for i in range(count)
    ]


def tube(path, radius, segments=10, material='iron', tint=WHITE, closed=False):
    """A round rod along points, without twist (each frame is the last one turned the least)."""
    path = [np.array(p, float) for p in path]
    n = len(path)
    tangents = []
    for i in range(n):
        before = path[i - 1] if i > 0 or closed else path[i]
        after = path[(i + 1) % n] if i < n - 1 or closed else path[i]
        tangents.append((after - before) / np.linalg.norm(after - before))
    side = np.cross(tangents[0], [0.0, 0.0, 1.0] if abs(tangents[0][2]) < 0.9 else [1.0, 0.0, 0.0])
    frames = []
    for p, t in zip(path, tangents):
        side = side - t * np.dot(side, t)
        side /= np.linalg.norm(side)
        frames.append((p, side, np.cross(t, side)))
    return sweep(circle(radius, segments), frames, material, tint, closed)


def rounded_path(points, radius, steps=4):
    """A polyline whose inner corners are replaced by curves, for pipes."""
    points = [np.array(p, float) for p in points]
    out = [points[0]]
    for a, b, c in zip(points, points[1:], points[2:]):
        u, v = (a - b) / np.linalg.norm(a - b), (c - b) / np.linalg.norm(c - b)
        p, q = b + u * radius, b + v * radius
        out += [(1 - t) ** 2 * p + 2 * t * (1 - t) * b + t**2 * q for t in np.linspace(0, 1, steps + 1)]
    return out + [points[-1]]


def cylinder(radius, lo, hi, segments=16, material='iron', tint=WHITE, axis='z', bevel=0.0):
    """A closed cylinder from lo to hi along an axis."""
    profile = [(radius, lo), (radius, hi)]
    if bevel > 0:
        profile = [(radius - bevel, lo), (radius, lo + bevel), (radius, hi - bevel), (radius - bevel, hi)]
    out = lathe(profile, segments, material, tint, phase=0.5)
    if axis == 'x':
        return out.turned('y', 90)
    return out.turned('x', -90) if axis == 'y' else out


def ring_prism(outer, inner, lo, hi, material='iron', tint=WHITE):
    """A plate along z with a hole: both outlines have equally many (x, y) points, counter-clockwise."""
    at = lambda loop, z: [(x, y, z) for x, y in loop]
    return solid(
        welded(rings([at(outer, lo), at(outer, hi), at(inner, hi), at(inner, lo), at(outer, lo)], material, tint))
    )
