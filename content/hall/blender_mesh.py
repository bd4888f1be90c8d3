"""From Parts to Blender meshes and objects."""
import math
import bpy
import numpy as np

SHARP_DEGREES = 38.0


def make_mesh(name, part, materials):
    """A mesh datablock: materials, texture coordinates in repeats, tints as point colours, sharp edges by angle."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(p) for p in part.points], [], part.faces)
    names = sorted(set(part.materials))
    for n in names:
        mesh.materials.append(materials[n].block)
    slots = {n: i for i, n in enumerate(names)}
    mesh.polygons.foreach_set('material_index', [slots[m] for m in part.materials])
    mesh.polygons.foreach_set('use_smooth', [True] * len(part.faces))
    set_uvs(mesh, part, materials)
    set_tints(mesh, part)
    mesh.use_auto_smooth = True
    mesh.auto_smooth_angle = math.radians(SHARP_DEGREES)
    mesh.validate()
    mesh.update()
    return mesh


def set_uvs(mesh, part, materials):
    layer = mesh.uv_layers.new(name='uv')
    flat = []
    for uv, material in zip(part.uvs, part.materials):
        size_u, size_v = materials[material].metres
        for u, v in uv:
            flat += [u / size_u, v / size_v]
    layer.data.foreach_set('uv', flat)


def set_tints(mesh, part):
    """Only where something is tinted: an all-white layer would be bytes for nothing.

    The colours sit on points, because the exporter of Blender 3.4 reads corner colours with point indices.
    """
    if all(t == (1.0, 1.0, 1.0) for t in part.tints):
        return
    layer = mesh.color_attributes.new(name='tint', type='BYTE_COLOR', domain='POINT')
    colours = np.ones((len(part.points), 4))
    for face, tint in zip(part.faces, part.tints):
        colours[list(face), :3] = tint
    layer.data.foreach_set('color', colours.ravel())


def place(name, mesh, location=(0, 0, 0), turn=(0, 0, 0), body=None, mass=None):
    """A node that draws a mesh. turn: degrees about x, y, z. body: the extras' nook_body (None: left out)."""
    node = bpy.data.objects.new(name, mesh)
    node.location = location
    node.rotation_euler = [math.radians(a) for a in turn]
    if body is not None:
        node['nook_body'] = bool(body)
    if mass is not None:
        node['nook_mass'] = float(mass)
    bpy.context.scene.collection.objects.link(node)
    return node


def world_points(node):
    """The node's vertices in world space, n x 3."""
    bpy.context.view_layer.update()
    flat = np.empty(len(node.data.vertices) * 3)
    node.data.vertices.foreach_get('co', flat)
    m = np.array(node.matrix_world)
    return flat.reshape(-1, 3) @ m[:3, :3].T + m[:3, 3]


def rest_on(node, z):
    """Moves the node up or down until its lowest vertex is at z."""
    node.location.z += z - float(world_points(node)[:, 2].min())
    bpy.context.view_layer.update()
    return node


def top_of(node):
    return float(world_points(node)[:, 2].max())
