"""Cameras and lights. Strengths are what the file says: lux for the sun, candela for the lanterns."""
import math
import bpy
from mathutils import Vector

SUN_LUX = 5.0
SUN_FROM = (-0.40, -0.27, 1.0)  # toward the sun
LANTERN_COLOUR = (1.0, 0.66, 0.34)

CAMERAS = {  # name: position, target, vertical field of view in degrees
    'hall': ((-11.3, -2.75, 1.7), (2.6, 1.35, 2.35), 56.0),
    'crates': ((-5.1, -1.5, 1.6), (-6.25, 2.7, 0.62), 47.0),
    'machine': ((0.35, 0.55, 1.75), (2.45, -2.6, 0.72), 46.0),
    'statue': ((-2.15, 0.55, 1.8), (0.0, 2.2, 1.42), 42.0),
    'gallery': ((9.4, 4.45, 6.4), (-3.0, -1.7, 1.7), 56.0),
}


def add_cameras(aspect=16 / 9):
    for name, (position, target, fov) in CAMERAS.items():
        data = bpy.data.cameras.new(name)
        data.sensor_fit = 'VERTICAL'
        data.angle_y = math.radians(fov)
        data.clip_start, data.clip_end = 0.05, 100.0
        node = bpy.data.objects.new(name, data)
        node.location = position
        node.rotation_euler = (Vector(target) - Vector(position)).to_track_quat('-Z', 'Y').to_euler()
        bpy.context.scene.collection.objects.link(node)
    bpy.context.scene.camera = bpy.data.objects['hall']


def add_sun():
    data = bpy.data.lights.new('sun', 'SUN')
    data.energy = SUN_LUX
    data.color = (1.0, 0.92, 0.78)
    data.angle = math.radians(0.6)
    node = bpy.data.objects.new('sun', data)
    node.rotation_euler = Vector(SUN_FROM).to_track_quat('Z', 'Y').to_euler()
    node.location = (0, 0, 12)
    bpy.context.scene.collection.objects.link(node)


def add_lantern_light(name, position, candela):
    """The exporter writes candela = watts / (4 pi) in its unitless mode."""
    data = bpy.data.lights.new(name, 'POINT')
    data.energy = candela * 4 * math.pi
    data.color = LANTERN_COLOUR
    data.shadow_soft_size = 0.05
    data.use_custom_distance, data.cutoff_distance = True, 9.0
    node = bpy.data.objects.new(name, data)
    node.location = position
    bpy.context.scene.collection.objects.link(node)
