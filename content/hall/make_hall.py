"""Makes Nook's demo level: blender -b -P content/hall/make_hall.py [-- OUTPUT.glb]"""
import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

import bpy
from check import check_hall
from building import build_hall
from export import export_glb
from furnishing import furnish
from materials import make_materials
from staging import add_cameras, add_sun


def output_path():
    after = sys.argv[sys.argv.index('--') + 1 :] if '--' in sys.argv else []
    return os.path.abspath(after[0]) if after else os.path.join(HERE, 'hall.glb')


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module='io_scene_gltf2')
    with tempfile.TemporaryDirectory() as folder:
        materials = make_materials(folder)
        build_hall(materials)
        furnish(materials)
        add_cameras()
        add_sun()
        complaints = check_hall()
        if complaints:
            sys.exit('\n'.join(['check: hall.glb is not written:'] + complaints))
        export_glb(output_path())


main()
