"""Writes the scene as one self-contained .glb."""
import json
import struct
import bpy


def export_glb(path, images='AUTO'):
    """images: AUTO keeps packed roughness and metalness as PNG, JPEG makes everything small."""
    bpy.ops.export_scene.gltf(
        filepath=path,
        export_format='GLB',
        export_copyright='Nook contributors, CC0 1.0',
        export_image_format=images,
        export_texcoords=True,
        export_normals=True,
        export_tangents=False,
        export_materials='EXPORT',
        export_colors=True,
        export_cameras=True,
        export_lights=True,
        convert_lighting_mode='COMPAT',
        export_extras=True,
        export_yup=True,
        export_apply=False,
        export_animations=False,
        export_skins=False,
        export_morph=False,
    )
    rewrite_json(path, tidy)


def tidy(scene):
    """Mends what Blender 3.4 writes: flags as numbers, lights as required, strengths with the noise of watts."""
    for node in scene['nodes']:
        for key in ('nook_body', 'nook_hung'):
            if key in node.get('extras', {}):
                node['extras'][key] = bool(node['extras'][key])
    scene.pop('extensionsRequired', None)
    for light in scene.get('extensions', {}).get('KHR_lights_punctual', {}).get('lights', []):
        light['intensity'] = round(light['intensity'], 3)
        light['color'] = [round(c, 3) for c in light['color']]


def rewrite_json(path, change):
    """Applies change to the JSON chunk of a .glb in place; the binary chunk stays as it is."""
    with open(path, 'rb') as f:
        data = f.read()
    length = struct.unpack('<I', data[12:16])[0]
    scene = json.loads(data[20 : 20 + length])
    change(scene)
    text = json.dumps(scene, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    rest = data[20 + length :]
    with open(path, 'wb') as f:
        f.write(struct.pack('<4sIIII', b'glTF', 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
