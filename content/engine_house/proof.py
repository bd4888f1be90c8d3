"""Proves what parts.glb promises: boxes, closed solids that look outward, nothing thinner than a voxel can hold."""
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

MILLIMETRE = 0.001
MOST_TRIANGLES = 25000
THINNEST = 0.0245  # metres; 2 cm voxels hold it
GROOVE = 0.015  # what is narrower is filled by 2 cm voxels: its sides are not looked at
NUDGE = 1e-5
NO_END = 1e9
SAMPLES = ((0.33, 0.33, 0.34), (0.52, 0.29, 0.19), (0.21, 0.51, 0.28))


def check_parts(entries, parts, meshes):
    """Returns the complaints as lines of text; prints the numbers."""
    complaints, total = [], 0
    for entry, part, mesh in zip(entries, parts, meshes):
        mesh.calc_loop_triangles()
        triangles = len(mesh.loop_triangles)
        total += triangles
        thin, where = thinnest(part)
        print(f'check: {entry.name}: {triangles} triangles, nowhere thinner than {100 * thin:.2f} cm (at {where})')
        complaints += [f'{entry.name}: {c}' for c in check_box(entry, part) + check_closed(part)]
        if thin < THINNEST:
            complaints.append(f'{entry.name}: {100 * thin:.2f} cm thin at {where}')
    print(f'check: {total} triangles in all')
    return complaints + ([f'{total} triangles, at most {MOST_TRIANGLES}'] if total > MOST_TRIANGLES else [])


def check_box(entry, part):
    off = np.abs(np.array([part.points.min(0) - entry.low, part.points.max(0) - entry.high])).max()
    found = [[round(float(c), 4) for c in p] for p in (part.points.min(0), part.points.max(0))]
    return [] if off <= MILLIMETRE else [f'its box is {found}']


def check_closed(part):
    """Every edge belongs to two faces that run along it in opposite ways, and every shell's volume is positive."""
    keys, ids = {}, []
    for p in part.points:
        ids.append(keys.setdefault(tuple(np.round(p, 6)), len(keys)))
    edges, shell = {}, list(range(len(keys)))
    for face in part.faces:
        corners = [ids[i] for i in face]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[a, b] = edges.get((a, b), 0) + 1
            shell[root(shell, a)] = root(shell, b)
    open_edges = sum(1 for (a, b), n in edges.items() if edges.get((b, a), 0) != n)
    volumes = {}
    for face in part.faces:
        p = part.points[list(face)]
        own = root(shell, ids[face[0]])
        for k in range(1, len(face) - 1):
            volumes[own] = volumes.get(own, 0.0) + np.dot(p[0], np.cross(p[k], p[k + 1])) / 6
    inward = sum(1 for v in volumes.values() if v <= 0)
    out = [f'{open_edges} open edges'] if open_edges else []
    return out + ([f'{inward} of {len(volumes)} shells look inward'] if inward else [])


def root(shell, i):
    while shell[i] != i:
        shell[i] = shell[shell[i]]
        i = shell[i]
    return i


def thinnest(part):
    """The least way straight inward from a triangle in the open to where all shells end together, and from where."""
    tree = BVHTree.FromPolygons([tuple(p) for p in part.points], part.faces)
    best, place = NO_END, None
    for corners in ((f[0], f[k], f[k + 1]) for f in part.faces for k in range(1, len(f) - 1)):
        p = part.points[list(corners)]
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        if np.linalg.norm(normal) < 1e-9:
            continue
        depth = depth_below(tree, p, Vector(normal).normalized())
        if depth < best:
            best, place = depth, tuple(round(float(c), 3) for c in p.mean(0))
    return best, place


def depth_below(tree, corners, normal):
    """The greatest of three places of a triangle: a ray that meets the edge of two faces counts one of them twice."""
    depths = []
    for weights in SAMPLES:
        start = Vector(np.array(weights) @ corners) + normal * NUDGE
        if in_the_open(tree, start, normal):
            depths.append(way_through(tree, start, -normal) - NUDGE)
    return max(depths, default=NO_END)


def in_the_open(tree, start, way):
    """No shell is left on the way out that was not entered on it, and none is nearer than a groove is wide."""
    inside = 0
    for normal, far in crossings(tree, start, way):
        if far < GROOVE:
            return False
        inside += 1 if normal.dot(way) < 0 else -1
        if inside < 0:
            return False
    return True


def way_through(tree, start, way):
    """How far from `start`, just outside, the ray leaves the last of the shells that overlap."""
    inside = 0
    for normal, far in crossings(tree, start, way):
        inside += 1 if normal.dot(way) < 0 else -1
        if inside == 0:
            return far
    return NO_END


def crossings(tree, start, way):
    gone = 0.0
    for _ in range(200):
        where, normal, _, distance = tree.ray_cast(start + way * gone, way)
        if where is None:
            return
        gone += distance
        yield normal, gone
        gone += 1e-6
