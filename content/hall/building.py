"""Puts the architecture together: each kind of bay is one mesh, drawn by several nodes that are no rigid bodies."""
import architecture as arch
import ends
import stairs
import vault
from blender_mesh import make_mesh, place
from plan import BAY, BAYS, HALF_LENGTH, ARCADE_Y, WALL_Y, GALLERY, LANDING_X, EAVES, bay_centres, bay_joints
from shapes import join

BALUSTRADE_Y = ARCADE_Y - 0.27


def build_hall(materials):
    mesh = lambda name, part: make_mesh(name, part, materials)
    place('floor', mesh('floor', arch.floor()), body=False)
    place('stairs', mesh('stairs', stairs.stairs()), body=False)
    place('east_wall', mesh('east_wall', ends.east_wall()), (HALF_LENGTH, 0, 0), (0, 0, -90), body=False)
    place('west_wall', mesh('west_wall', ends.west_wall()), (-HALF_LENGTH, 0, 0), (0, 0, 90), body=False)
    build_sides(mesh)
    build_balustrades(mesh)
    build_vault(mesh)


def build_sides(mesh):
    """Arcades, galleries and walls. side -1 is the north (y > 0): a bay's +y looks into the nave, walls' -y."""
    bay = mesh('arcade_bay', join([arch.arcade_bay(), arch.gallery_slab()]))
    pier = mesh('column', arch.column())
    beam = mesh('gallery_beam', arch.gallery_beam())
    lower = mesh('aisle_wall_bay', arch.aisle_wall_bay())
    windows = mesh('window_bay', arch.upper_wall_bay(True))
    blind = mesh('blind_bay', arch.upper_wall_bay(False))
    pilasters = mesh(
        'pilasters',
        join([arch.pilaster(0.5, 0.12, -0.02, 4.02, 0.0), arch.pilaster(0.5, 0.13, GALLERY - 0.02, EAVES - 0.08, 0.0)]),
    )
    for label, side in (('north', 1), ('south', -1)):
        turn = (0, 0, 180 if side > 0 else 0)
        wall_turn = (0, 0, 0 if side > 0 else 180)
        for i, x in enumerate(bay_centres()):
            place(f'arcade_{label}_{i}', bay, (x, side * ARCADE_Y, 0), turn, body=False)
            place(f'aisle_wall_{label}_{i}', lower, (x, side * WALL_Y, 0), wall_turn, body=False)
            place(
                f'upper_wall_{label}_{i}', blind if side > 0 else windows, (x, side * WALL_Y, 0), wall_turn, body=False
            )
        for i, x in enumerate(bay_joints()):
            place(f'column_{label}_{i}', pier, (x, side * ARCADE_Y, 0), body=False)
            place(f'gallery_beam_{label}_{i}', beam, (x, side * ARCADE_Y, 0), turn, body=False)
            place(f'pilasters_{label}_{i}', pilasters, (x, side * WALL_Y, 0), wall_turn, body=False)


def build_balustrades(mesh):
    """Five whole bays on each side and a short one that leaves room where the stairs arrive."""
    whole = mesh('balustrade', arch.balustrade(BAY, 8))
    short_length = LANDING_X - HALF_LENGTH + BAY
    short = mesh(
        'balustrade_short', join([arch.balustrade(short_length, 5), arch.pedestal().moved(short_length, 0, 0)])
    )
    for label, side in (('north', 1), ('south', -1)):
        for i, x in enumerate(bay_joints()[:-1]):
            which = whole if i < BAYS - 1 else short
            place(f'balustrade_{label}_{i}', which, (x, side * BALUSTRADE_Y, GALLERY), body=False)


def build_vault(mesh):
    closed, opened = mesh('vault_bay', vault.vault_bay(False)), mesh('vault_bay_open', vault.vault_bay(True))
    rib = mesh('vault_rib', vault.vault_rib())
    for i, x in enumerate(bay_centres()):
        place(f'vault_{i}', opened if i < BAYS - 1 else closed, (x, 0, 0), body=False)
    for i, x in enumerate(bay_joints()):
        place(f'vault_rib_{i}', rib, (x, 0, 0), body=False)
