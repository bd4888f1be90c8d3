"""The materials: pictures from textures.py, saved as JPEG in a scratch folder and wired for the glTF exporter."""
import os
import bpy
import numpy as np
import textures as tex

SEED = 20240607


class Material:
    """block: Blender's material. metres: what one repeat of the texture covers (u, v)."""

    def __init__(self, block, metres):
        self.block, self.metres = block, metres


def make_materials(folder):
    """All materials by name; their pictures are written to `folder`, which must outlive the export."""
    out = {}
    for number, (name, painter, pixels, metres, rough, metalness) in enumerate(RECIPES):
        rng = np.random.default_rng(SEED + number)
        fields = painter(rng, pixels)
        out[name] = textured(name, folder, fields, metres, rough, metalness)
    for name, colour, rough, metalness in PLAIN:
        out[name] = Material(plain(name, colour, rough, metalness), (1.0, 1.0))
    out['glow'] = Material(glowing('glow', (1.0, 0.62, 0.25), 6.0), (1.0, 1.0))
    return out


RECIPES = [  # name, painter, pixels (rows, columns), metres (u, v), roughness, metalness
    ('plaster', tex.plaster, (512, 512), (4.0, 4.0), 0.92, 0.0),
    ('ashlar', tex.ashlar, (512, 512), (2.0, 2.0), 0.85, 0.0),
    ('stone', tex.limestone, (512, 512), (2.0, 2.0), 0.78, 0.0),
    ('marble', tex.marble, (512, 512), (2.0, 2.0), 0.38, 0.0),
    ('wood', tex.wood, (256, 512), (1.0, 0.5), 0.62, 0.0),
    ('teal', lambda r, s: tex.paint(r, s, (0.04, 0.31, 0.315)), (512, 512), (1.0, 1.0), None, None),
    ('ochre', lambda r, s: tex.paint(r, s, (0.52, 0.27, 0.055), 0.42), (256, 256), (1.0, 1.0), None, None),
    ('iron', lambda r, s: tex.metal(r, s, (0.30, 0.30, 0.31), (0.135, 0.12, 0.11)), (256, 256), (0.5, 0.5), None, None),
    (
        'brass',
        lambda r, s: tex.metal(r, s, (0.86, 0.62, 0.27), (0.47, 0.30, 0.115)),
        (256, 256),
        (0.5, 0.5),
        None,
        None,
    ),
    ('cloth', tex.cloth, (256, 256), (0.25, 0.25), 0.95, 0.0),
]

PLAIN = [('leather', (1.0, 1.0, 1.0), 0.55, 0.0), ('paper', (0.78, 0.71, 0.57), 0.9, 0.0)]


# ---- Blender materials ----


def plain(name, colour, rough, metalness):
    block, shader = shader_block(name)
    shader.inputs['Roughness'].default_value = rough
    shader.inputs['Metallic'].default_value = metalness
    tinted(block, shader, None, colour)
    return block


def glowing(name, colour, strength):
    block, shader = shader_block(name)
    shader.inputs['Base Color'].default_value = (*colour, 1.0)
    shader.inputs['Emission'].default_value = (*colour, 1.0)
    shader.inputs['Emission Strength'].default_value = strength
    return block


def textured(name, folder, fields, metres, rough, metalness):
    """fields: colour and height, and for metals roughness and metalness fields."""
    block, shader = shader_block(name)
    colour = picture_node(block, save_picture(folder, name + '_colour', srgb(fields[0]), 88), False)
    tinted(block, shader, colour, None)
    normal = picture_node(block, save_picture(folder, name + '_normal', tex.normal_map(fields[1], metres), 90), True)
    bend = block.node_tree.nodes.new('ShaderNodeNormalMap')
    block.node_tree.links.new(normal.outputs['Color'], bend.inputs['Color'])
    block.node_tree.links.new(bend.outputs['Normal'], shader.inputs['Normal'])
    if rough is None:
        wire_metal(block, shader, save_picture(folder, name + '_metal_rough', metal_rough(fields), 86))
    else:
        shader.inputs['Roughness'].default_value = rough
        shader.inputs['Metallic'].default_value = metalness
    return Material(block, metres)


def shader_block(name):
    block = bpy.data.materials.new(name)
    block.use_nodes = True
    block.use_backface_culling = True
    return block, block.node_tree.nodes['Principled BSDF']


def tinted(block, shader, picture, colour):
    """Base colour = picture (or a colour) times the corner colours, as glTF does it with COLOR_0."""
    nodes, links = block.node_tree.nodes, block.node_tree.links
    if picture is None:
        shader.inputs['Base Color'].default_value = (*colour, 1.0)
        return
    tint = nodes.new('ShaderNodeVertexColor')
    tint.layer_name = 'tint'
    times = nodes.new('ShaderNodeMixRGB')
    times.blend_type = 'MULTIPLY'
    times.inputs['Fac'].default_value = 1.0
    links.new(picture.outputs['Color'], times.inputs['Color1'])
    links.new(tint.outputs['Color'], times.inputs['Color2'])
    links.new(times.outputs['Color'], shader.inputs['Base Color'])


def wire_metal(block, shader, image):
    """glTF's packing: green is roughness, blue is metalness."""
    picture = picture_node(block, image, True)
    split = block.node_tree.nodes.new('ShaderNodeSeparateRGB')
    links = block.node_tree.links
    links.new(picture.outputs['Color'], split.inputs['Image'])
    links.new(split.outputs['G'], shader.inputs['Roughness'])
    links.new(split.outputs['B'], shader.inputs['Metallic'])


def picture_node(block, image, is_data):
    node = block.node_tree.nodes.new('ShaderNodeTexImage')
    node.image = image
    image.colorspace_settings.name = 'Non-Color' if is_data else 'sRGB'
    return node


# ---- pictures ----


def srgb(linear):
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def metal_rough(fields):
    _, _, rough, metalness = fields
    return np.stack([np.ones_like(rough), np.clip(rough, 0, 1), np.clip(metalness, 0, 1)], -1)


def save_picture(folder, name, rgb, quality):
    """Writes rgb in [0, 1], row 0 at the bottom, as it is (no colour transform) and loads it back."""
    rows, columns, _ = rgb.shape
    scratch = bpy.data.images.new(name, columns, rows)
    scratch.colorspace_settings.name = 'Non-Color'
    scratch.pixels.foreach_set(np.concatenate([rgb, np.ones((rows, columns, 1))], -1).astype(np.float32).ravel())
    settings = bpy.context.scene.render.image_settings
    settings.file_format, settings.color_mode, settings.quality = 'JPEG', 'RGB', quality
    bpy.context.scene.view_settings.view_transform = 'Raw'
    path = os.path.join(folder, name + '.jpg')
    scratch.save_render(path)
    bpy.data.images.remove(scratch)
    return bpy.data.images.load(path)
