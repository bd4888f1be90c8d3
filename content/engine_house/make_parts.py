"""Makes the movable parts of the engine house: blender -b -P content/engine_house/make_parts.py [-- OUTPUT.glb]"""
import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), 'hall')]
sys.dont_write_bytecode = True

import bpy
from blender_mesh import make_mesh, place
from catalogue import PARTS
from export import export_glb
from finishes import make_finishes
from proof import check_parts


def output_path():
    after = sys.argv[sys.argv.index('--') + 1 :] if '--' in sys.argv else []
    return os.path.abspath(after[0]) if after else os.path.join(HERE, 'parts.glb')


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module='io_scene_gltf2')
    with tempfile.TemporaryDirectory() as folder:
        materials = make_finishes(folder)
        parts = [entry.build() for entry in PARTS]
        meshes = [make_mesh(entry.name, part, materials) for entry, part in zip(PARTS, parts)]
        for entry, mesh in zip(PARTS, meshes):
            place(entry.name, mesh, body=entry.is_body, mass=entry.mass)
        complaints = check_parts(PARTS, parts, meshes)
        if complaints:
            sys.exit('\n'.join(['check: parts.glb is not written:'] + complaints))
        export_glb(output_path(), 'JPEG')


main()
