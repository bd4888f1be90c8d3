"""Proves that every body rests (lifted by a millimetre it is free, lowered by a millimetre it is not) and that all
faces that can be seen from the hall's air look into it."""
import random
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

MILLIMETRE = 0.001
MOST_TRIANGLES = 120000
AIR = [
    (x, y, z)
    for x in (-10.0, -6.2, -2.1, 2.0, 6.1)
    for y, z in ((0.6, 1.1), (0.6, 5.9), (5.7, 2.9), (-5.7, 2.9), (5.4, 6.2), (-5.4, 6.2))
]
RAYS = 3000  # from each point of AIR


def check_hall():
    """Returns the complaints as lines of text; prints the numbers."""
    bpy.context.view_layer.update()
    drawn = [o for o in bpy.context.scene.objects if o.type == 'MESH']
    triangles = sum(triangle_count(o.data) for o in drawn)
    bodies = [o for o in drawn if o.get('nook_body')]
    print(f'check: {triangles} triangles, {len(drawn)} mesh nodes, {len(bodies)} bodies')
    complaints = [] if triangles <= MOST_TRIANGLES else [f'{triangles} triangles, at most {MOST_TRIANGLES}']
    points = {o.name: [o.matrix_world @ v.co for v in o.data.vertices] for o in drawn}
    complaints += check_facing()
    for o in bodies:
        if not o.get('nook_hung'):
            complaints += check_contact(o, drawn, points)
    return complaints


def triangle_count(mesh):
    mesh.calc_loop_triangles()
    return len(mesh.loop_triangles)


def check_facing():
    """Rays from points in the open: what they hit first must not show its back."""
    rng, backs = random.Random(1), {}
    graph = bpy.context.evaluated_depsgraph_get()
    for origin in AIR:
        for _ in range(RAYS):
            way = Vector([rng.gauss(0, 1) for _ in range(3)]).normalized()
            hit, where, normal, _, o, _ = bpy.context.scene.ray_cast(graph, Vector(origin), way)
            if hit and normal.dot(way) > 1e-4:
                backs.setdefault(o.name, []).append(tuple(round(c, 2) for c in where))
    return [
        f'{name} shows its back at {len(places)} places, the first at {places[0]}' for name, places in backs.items()
    ]


def check_contact(body, drawn, points):
    top = max(p.z for p in points[body.name])
    carried = lambda o: o.get('nook_hung') or min(p.z for p in points[o.name]) > top - MILLIMETRE
    near = [
        o
        for o in drawn
        if o is not body and not carried(o) and boxes_meet(points[body.name], points[o.name], 2 * MILLIMETRE)
    ]
    lifted = touched(body, near, points, MILLIMETRE)
    lowered = touched(body, near, points, -MILLIMETRE)
    out = [f'{body.name} sinks into {", ".join(lifted)}'] if lifted else []
    return out if lowered else out + [f'{body.name} stands on nothing']


def touched(body, near, points, lift):
    moved = tree(body, points, lift)
    return [o.name for o in near if moved.overlap(tree(o, points, 0.0))]


def tree(o, points, lift):
    up = Vector((0, 0, lift))
    return BVHTree.FromPolygons([p + up for p in points[o.name]], [tuple(p.vertices) for p in o.data.polygons])


def boxes_meet(a, b, margin):
    return all(
        min(p[k] for p in a) <= max(p[k] for p in b) + margin and min(p[k] for p in b) <= max(p[k] for p in a) + margin
        for k in range(3)
    )
