"""The hall's measures, in metres: x along the hall (the door at -x), y across it, z up."""
BAY = 4.0  # between columns
BAYS = 6
HALF_LENGTH = BAY * BAYS / 2
ARCADE_Y = 4.5  # the columns' axis
ARCADE_HALF = 0.3  # half the arcade wall's thickness
WALL_Y = 7.0  # inner face of the long walls
WALL_DEPTH = 0.95  # room for the niches
SPRING = 2.5  # top of the columns
ARCH_RADIUS = 1.65
RISER = 0.175
STEPS = 13  # risers in a flight; two flights lead to the gallery
GALLERY = 2 * STEPS * RISER
LANDING = STEPS * RISER
LANDING_X = 9.9  # the landing reaches from here to the end wall
LANDING_HALF = 1.15
EAVES = 7.2  # where the vault springs from the long walls
VAULT_RISE = 2.0
VAULT_RADIUS = (WALL_Y**2 + VAULT_RISE**2) / (2 * VAULT_RISE)
VAULT_CENTRE = EAVES + VAULT_RISE - VAULT_RADIUS


def bay_centres():
    return [-HALF_LENGTH + BAY * (i + 0.5) for i in range(BAYS)]


def bay_joints():
    return [-HALF_LENGTH + BAY * i for i in range(BAYS + 1)]
