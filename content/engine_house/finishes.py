"""The hall's materials and more: wrought iron, bronze and dark stone by their pictures, red paint, a dark crystal."""
import numpy as np
import textures as tex
from materials import Material, make_materials, picture_node, save_picture, shader_block, srgb, textured
from solids import METAL_REPEAT, METALS

SEED = 20241130
METAL_SIZE = (METAL_REPEAT, METAL_REPEAT)
DYED = {
    'wrought': ('iron', (0.42, 0.42, 0.45)),
    'bronze': ('brass', (0.62, 0.54, 0.56)),
    'flagstone': ('stone', (0.36, 0.36, 0.40)),
}
RED = (0.40, 0.025, 0.018)
NIGHT = (0.012, 0.009, 0.030)
CORE = (0.020, 0.014, 0.075)  # linear light at the brightest place


def make_finishes(folder):
    """All materials by name; their pictures are written to `folder`, which must outlive the export."""
    out = make_materials(folder)
    rng = np.random.default_rng(SEED)
    out['red'] = textured('red', folder, tex.paint(rng, (256, 256), RED, 0.30), METAL_SIZE, None, None)
    for name, (like, factor) in DYED.items():
        out[name] = Material(dyed(name, out[like].block, factor), out[like].metres)
    for name in METALS:
        out[name] = Material(out[name].block, METAL_SIZE)
    out['night'] = Material(night(folder), (1.0, 1.0))
    return out


def dyed(name, like, factor):
    """A copy whose base colour is that of `like` times a constant, without corner colours."""
    block = like.copy()
    block.name = name
    nodes, links = block.node_tree.nodes, block.node_tree.links
    shader = nodes['Principled BSDF']
    old = shader.inputs['Base Color'].links[0].from_node
    picture = old.inputs['Color1'].links[0].from_socket
    nodes.remove(old)
    times = nodes.new('ShaderNodeMix')
    times.data_type, times.blend_type = 'RGBA', 'MULTIPLY'
    times.inputs['Factor'].default_value = 1.0
    colours = [s for s in times.inputs if s.type == 'RGBA']
    links.new(picture, colours[0])
    colours[1].default_value = (*factor, 1.0)
    links.new([s for s in times.outputs if s.type == 'RGBA'][0], shader.inputs['Base Color'])
    return block


def night(folder):
    block, shader = shader_block('night')
    shader.inputs['Base Color'].default_value = (*NIGHT, 1.0)
    shader.inputs['Roughness'].default_value = 0.10
    shader.inputs['Metallic'].default_value = 0.0
    glow = save_picture(folder, 'night_glow', srgb(core_picture(np.random.default_rng(SEED))), 90)
    light = picture_node(block, glow, False)
    block.node_tree.links.new(light.outputs['Color'], shader.inputs['Emission'])
    shader.inputs['Emission Strength'].default_value = 1.0
    return block


def core_picture(rng, size=(128, 64)):
    """Light along the middle of a facet, brightest at a third of its height, with darker clouds in it."""
    rows, columns = size
    v, u = np.meshgrid((np.arange(rows) + 0.5) / rows, (np.arange(columns) + 0.5) / columns, indexing='ij')
    across = np.exp(-(((u - 0.5) / 0.34) ** 2))
    along = np.exp(-(((v - 0.34) / 0.26) ** 2))
    cloud = 0.35 + 0.9 * tex.clouds(rng, size, (6, 3), 4)
    return (across * along * cloud)[..., None] * np.array(CORE)
