"""Makes soft_balls.gltf and soft_balls.nrrd beside this file: a floor, a wall, and two balls of fog that only occlusion shows.

    python3 content/soft_balls/make_soft_balls.py

A sample is 255 (1 - r^2 / R^2)^2 in a ball of radius R around its centre, 0 outside: tests compare pictures with that formula.
"""
import base64
import gzip
import json
import pathlib
import struct

SPACING = 0.05  # metres between samples
SAMPLES = (48, 24, 24)
BALLS = (((0.6, 0.6, 0.6), 0.55), ((1.8, 0.45, 0.6), 0.42))  # centre, radius: metres from the field's corner
CORNER = (-1.2, 0.0, -0.6)  # of the field, in the world
BOXES = (((-2.0, -0.1, -1.1), (2.0, 0.0, 1.6)), ((-2.0, 0.0, -1.1), (2.0, 1.6, -1.0)))  # floor, wall: low, high


def sample(position):
    value = 0.0
    for centre, radius in BALLS:
        part = sum((p - c) ** 2 for p, c in zip(position, centre)) / radius ** 2
        value = max(value, 255.0 * (1.0 - part) ** 2 if part < 1.0 else 0.0)
    return round(value)


def field():
    header = ('NRRD0004\n# two soft balls, CC0\ntype: uchar\ndimension: 3\nsizes: {} {} {}\nspacings: {s} {s} {s}\nencoding: gzip\n\n'
              .format(*SAMPLES, s=SPACING))
    samples = bytes(sample([(i + 0.5) * SPACING for i in (x, y, z)])
                    for z in range(SAMPLES[2]) for y in range(SAMPLES[1]) for x in range(SAMPLES[0]))
    return header.encode() + gzip.compress(samples, 9, mtime=0)


def box(low, high):
    """24 corners with their normals, 36 indices, counter-clockwise from outside."""
    corners, indices = [], []
    for axis in range(3):
        for side in (0, 1):
            normal = [0.0, 0.0, 0.0]
            normal[axis] = 1.0 if side else -1.0
            first = len(corners)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = [0.0, 0.0, 0.0]
                at[axis] = (low, high)[side][axis]
                at[(axis + 1) % 3] = (low, high)[a][(axis + 1) % 3]
                at[(axis + 2) % 3] = (low, high)[b][(axis + 2) % 3]
                corners.append(tuple(at) + tuple(normal))
            turn = (0, 1, 2, 0, 2, 3) if side else (0, 2, 1, 0, 3, 2)
            indices += [first + i for i in turn]
    return corners, indices


def mesh(data, accessors, low, high):
    corners, indices = box(low, high)
    start = len(data)
    data += b''.join(struct.pack('<6f', *corner) for corner in corners)
    data += struct.pack('<36H', *indices)
    first = len(accessors)
    accessors += [
        {'bufferView': 0, 'byteOffset': start, 'componentType': 5126, 'count': 24, 'type': 'VEC3', 'min': low, 'max': high},
        {'bufferView': 0, 'byteOffset': start + 12, 'componentType': 5126, 'count': 24, 'type': 'VEC3'},
        {'bufferView': 1, 'byteOffset': start + 24 * 24, 'componentType': 5123, 'count': 36, 'type': 'SCALAR'},
    ]
    return {'primitives': [{'attributes': {'POSITION': first, 'NORMAL': first + 1}, 'indices': first + 2, 'material': 0}]}


def scene():
    data, accessors = bytearray(), []
    meshes = [mesh(data, accessors, *corners) for corners in BOXES]
    uri = 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()
    density = {'file': 'soft_balls.nrrd', 'window': [0, 300], 'length': 0.1}
    return {
        'asset': {'version': '2.0', 'copyright': 'CC0'},
        'scene': 0,
        'scenes': [{'nodes': [0, 1, 2, 3]}],
        'nodes': [
            {'name': 'floor', 'mesh': 0},
            {'name': 'wall', 'mesh': 1},
            {'name': 'soft balls', 'translation': CORNER, 'extras': {'nook_density': density}},
            {'name': 'front', 'camera': 0, 'translation': [0.0, 1.7, 3.4], 'rotation': [-0.2079117, 0.0, 0.0, 0.9781476]},
        ],
        'cameras': [{'name': 'front', 'type': 'perspective', 'perspective': {'yfov': 0.8, 'znear': 0.05}}],
        'materials': [{'name': 'plaster', 'pbrMetallicRoughness': {'baseColorFactor': [0.8, 0.8, 0.8, 1.0], 'metallicFactor': 0.0}}],
        'meshes': meshes,
        'accessors': accessors,
        'bufferViews': [{'buffer': 0, 'byteLength': len(data), 'byteStride': 24}, {'buffer': 0, 'byteLength': len(data)}],
        'buffers': [{'byteLength': len(data), 'uri': uri}],
    }


if __name__ == '__main__':
    folder = pathlib.Path(__file__).parent
    (folder / 'soft_balls.nrrd').write_bytes(field())
    (folder / 'soft_balls.gltf').write_text(json.dumps(scene(), indent=1) + '\n')
