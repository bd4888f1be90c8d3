"""Where the movable things stand. All rest on what carries them; check_contacts proves it at every run."""
import math
import bodies
import machine
import statue
from blender_mesh import make_mesh, place, rest_on, top_of
from plan import ARCADE_Y, WALL_Y, LANDING_X, bay_centres
from staging import add_lantern_light

FLOOR = 0.0


def furnish(materials):
    mesh = lambda name, part: make_mesh(name, part, materials)
    put_crates(mesh)
    put_steel(mesh)
    put_machine(mesh)
    put_statue(mesh)
    put_small_things(mesh)


def body(name, mesh, x, y, z, turn=(0, 0, 0), mass=None):
    return rest_on(place(name, mesh, (x, y, 0), turn, True, mass), z)


def put_crates(mesh):
    """Three sizes in two heaps; one crate leans on another, one lies on its side."""
    large = mesh('crate_large', bodies.crate(1.0, 1.0, 0.9, 1))
    middle = mesh('crate_middle', bodies.crate(0.9, 0.62, 0.6, 2))
    small = mesh('crate_small', bodies.crate(0.5, 0.42, 0.36, 3, False))
    first = body('crate_large_0', large, -7.3, 3.05, FLOOR, (0, 0, 7), 90)
    body('crate_large_1', large, -6.05, 3.15, FLOOR, (0, 0, -4), 90)
    upper = body('crate_middle_0', middle, -7.15, 3.0, top_of(first), (0, 0, 24), 45)
    body('crate_small_0', small, -7.1, 3.05, top_of(upper), (0, 0, -12), 15)
    body('crate_small_1', small, -6.2, 3.3, top_of(first), (0, 0, 33), 15)
    body('crate_middle_1', middle, -8.35, 2.25, FLOOR, (90, 0, 64), 45)
    body('crate_small_2', small, -5.75, 2.15, FLOOR, (0, 0, 50), 15)
    lean_crate(small)
    stack = body('crate_middle_2', middle, 4.6, 3.2, FLOOR, (0, 0, 3), 45)
    body('crate_middle_3', middle, 4.65, 3.17, top_of(stack), (0, 0, -9), 45)
    body('crate_large_2', large, 3.3, 3.15, FLOOR, (0, 0, -11), 90)
    body('crate_large_3', large, -3.4, -6.1, FLOOR, (0, 0, 4), 90)


def lean_crate(small):
    """A small crate tilted against the front of crate_large_0: it stands on one edge and touches with another."""
    tilt, gap = 24.0, 0.0004
    turn = math.radians(7)
    front = (math.sin(turn), -math.cos(turn))  # out of the large crate's face
    depth, height = 0.42, 0.36
    # the highest-rear edge touches: it is this far behind the crate's own origin
    reach = depth / 2 * math.cos(math.radians(tilt)) + height * math.sin(math.radians(tilt))
    away = 0.5 + gap + reach
    body(
        'crate_small_3',
        small,
        -7.3 + front[0] * away - 0.12 * math.cos(turn),
        3.05 + front[1] * away - 0.12 * math.sin(turn),
        FLOOR,
        (-tilt, 0, 7),
        15,
    )


def put_steel(mesh):
    teal, ochre = mesh('drum_teal', bodies.drum('teal')), mesh('drum_ochre', bodies.drum('ochre'))
    flat = 360.0 / 44  # a facet of 22 faces down, not a corner
    body('drum_teal_0', teal, -4.85, 3.3, FLOOR, (0, 0, 15), 22)
    body('drum_teal_1', teal, -4.27, 2.95, FLOOR, (0, 0, 100), 22)
    body('drum_ochre_0', ochre, -4.82, 2.5, FLOOR, (0, 0, 200), 22)
    body('drum_ochre_1', ochre, -7.95, 0.95, FLOOR, (90, flat, 62), 22)
    body('drum_teal_2', teal, 5.4, -3.1, FLOOR, (0, 0, 60), 22)
    body('drum_teal_3', teal, 0.9, -5.6, FLOOR, (90, flat, 12), 22)
    pail = mesh('bucket', bodies.bucket())
    body('bucket_0', pail, -4.35, 2.05, FLOOR, (0, 0, 30), 2)
    body('bucket_1', pail, 0.55, -3.4, FLOOR, (0, 0, 140), 2)
    body('chain', mesh('chain', bodies.chain(17, 5)), -6.9, 1.35, FLOOR, (0, 0, -20), 12)


def put_machine(mesh):
    x, y, turn = 2.6, -2.9, 180
    body('engine', mesh('engine', machine.engine_bed()), x, y, FLOOR, (0, 0, turn), 1400)
    wheel = place(
        'flywheel',
        mesh('flywheel', machine.flywheel()),
        (x - machine.SHAFT_X, y - machine.WHEEL_Y, machine.SHAFT_Z),
        (0, 0, turn),
        True,
        380,
    )
    wheel['nook_hung'] = True
    body('loose_gear', mesh('loose_gear', machine.loose_gear()), 1.75, -1.55, FLOOR, (0, 0, 9), 30)


def put_statue(mesh):
    stone = body('plinth', mesh('plinth', statue.plinth()), 0.0, 2.2, FLOOR, (0, 0, 0), 900)
    body('owl', mesh('owl', statue.owl()), 0.0, 2.2, top_of(stone), (0, 0, 218), 420)
    urn = mesh('urn', statue.urn())
    for i, x in enumerate(bay_centres()):
        if i in (0, 2, 4):
            body(f'urn_{i}', urn, x, WALL_Y + 0.28, 0.62, (0, 0, 10 * i), 60)


def put_small_things(mesh):
    keg = mesh('barrel', bodies.barrel())
    body('barrel_0', keg, -1.7, 3.35, FLOOR, (0, 0, 9), 40)
    body('barrel_1', keg, -2.45, 3.3, FLOOR, (0, 0, 70), 40)
    body('barrel_2', keg, -9.4, 3.2, FLOOR, (90, 10, 20), 40)
    seat = body('bench', mesh('bench', bodies.bench()), -5.5, -3.0, FLOOR, (0, 0, 8), 25)
    last = seat
    for i, (width, depth, thick, tint, dx, turn) in enumerate(BOOKS):
        level = top_of(seat if i == 3 else last)  # a pile of three, and one beside it
        last = body(
            f'book_{i}',
            mesh(f'book_{i}', bodies.book(width, depth, thick, tint)),
            -5.5 + dx,
            -3.0 + 0.14 * dx,
            level,
            (0, 0, turn),
            1,
        )
    for i, (x, y, turn) in enumerate(((-3.9, -2.75, 20), (-3.45, -3.2, 130))):
        body(f'sack_{i}', mesh(f'sack_{i}', bodies.sack(i)), x, y, FLOOR, (0, 0, turn), 30)
    put_lanterns(mesh, seat)


BOOKS = [  # width, depth, thickness, tint, shift along the bench, turn
    (0.20, 0.28, 0.055, (0.30, 0.06, 0.045), 0.30, 8),
    (0.18, 0.25, 0.04, (0.05, 0.13, 0.16), 0.30, -14),
    (0.15, 0.21, 0.035, (0.33, 0.22, 0.08), 0.31, 27),
    (0.19, 0.26, 0.05, (0.07, 0.12, 0.05), -0.22, 80),
]


def put_lanterns(mesh, seat):
    """Standing lanterns, each with its light."""
    lamp = mesh('lantern', bodies.lantern())
    newel_x = LANDING_X - 12 * 0.30 - 0.24
    spots = [
        (newel_x, 1.40, 1.25, 5.0),
        (newel_x, -1.40, 1.25, 5.0),
        (-6.1, -3.085, top_of(seat), 3.0),
        (-5.72, 2.82, 0.9, 3.5),
        (2.45, -1.7, FLOOR, 3.0),
        (6.0, -ARCADE_Y - 1.3, FLOOR, 4.0),
    ]
    for i, (x, y, z, candela) in enumerate(spots):
        body(f'lantern_{i}', lamp, x, y, z, (0, 0, 17 * i), 2)
        add_lantern_light(f'lantern_light_{i}', (x, y, z + bodies.LANTERN_FLAME), candela)
