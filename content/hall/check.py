"""Proves that every body rests: lifted by a millimetre it is free, lowered by a millimetre it is not."""
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

MILLIMETRE = 0.001
MOST_TRIANGLES = 120000


def check_hall():
    """Returns the complaints as lines of text; prints the numbers."""
    bpy.context.view_layer.update()
    drawn = [o for o in bpy.context.scene.objects if o.type == 'MESH']
    triangles = sum(triangle_count(o.data) for o in drawn)
    bodies = [o for o in drawn if o.get('nook_body')]
    print(f'check: {triangles} triangles, {len(drawn)} mesh nodes, {len(bodies)} bodies')
    complaints = [] if triangles <= MOST_TRIANGLES else [f'{triangles} triangles, at most {MOST_TRIANGLES}']
    points = {o.name: [o.matrix_world @ v.co for v in o.data.vertices] for o in drawn}
    for o in bodies:
        if not o.get('nook_hung'):
            complaints += check_contact(o, drawn, points)
    return complaints


def triangle_count(mesh):
    mesh.calc_loop_triangles()
    return len(mesh.loop_triangles)


def check_contact(body, drawn, points):
    top = max(p.z for p in points[body.name])
    carried = lambda o: o.get('nook_hung') or min(p.z for p in points[o.name]) > top - MILLIMETRE
    near = [o for o in drawn if o is not body and not carried(o) and boxes_meet(points[body.name], points[o.name], 2 * MILLIMETRE)]
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
    return all(min(p[k] for p in a) <= max(p[k] for p in b) + margin and min(p[k] for p in b) <= max(p[k] for p in a) + margin for k in range(3))
