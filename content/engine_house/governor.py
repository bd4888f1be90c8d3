"""The flyball governor: two balls on arms about a spindle; the sleeve slides up as they fly out. Stands on z = 0."""
import math
from shapes import cylinder, join, tube
from solids import ball, bolt, turned_solid

BALL, REACH, BALL_Z = 0.046, 0.124, 0.262
ARM = 0.0140


def governor():
    parts = foot() + [cylinder(0.017, 0.14, 0.46, 14, 'iron')] + sleeve() + head()
    for side in (-1, 1):
        parts += arms(side)
    return join(parts)


def foot():
    profile = [
        (0.0, 0.0),
        (0.108, 0.0),
        (0.114, 0.006),
        (0.114, 0.026),
        (0.108, 0.032),
        (0.072, 0.036),
        (0.052, 0.052),
        (0.041, 0.080),
        (0.037, 0.116),
        (0.046, 0.124),
        (0.050, 0.132),
        (0.046, 0.140),
        (0.030, 0.146),
        (0.0, 0.146),
    ]
    around = [2 * math.pi * (i + 0.5) / 6 for i in range(6)]
    bolts = [bolt(0.0145, 0.008).moved(0.090 * math.cos(a), 0.090 * math.sin(a), 0.033) for a in around]
    return [turned_solid(profile, 28, 'brass')] + bolts


def sleeve():
    profile = [
        (0.0, 0.160),
        (0.036, 0.160),
        (0.042, 0.166),
        (0.042, 0.186),
        (0.035, 0.192),
        (0.035, 0.222),
        (0.027, 0.230),
        (0.0, 0.230),
    ]
    return [turned_solid(profile, 16, 'brass')] + [fork(0.034, 0.208, s) for s in (-1, 1)]


def head():
    profile = [
        (0.0, 0.408),
        (0.026, 0.408),
        (0.036, 0.416),
        (0.036, 0.442),
        (0.024, 0.452),
        (0.018, 0.458),
        (0.018, 0.464),
        (0.029, 0.473),
        (0.031, 0.483),
        (0.024, 0.494),
        (0.010, 0.500),
        (0.0, 0.500),
    ]
    return [turned_solid(profile, 16, 'brass')] + [fork(0.038, 0.428, s) for s in (-1, 1)]


def fork(x, z, side):
    """A joint: an iron pin across the arm's end."""
    return cylinder(0.0175, -0.021, 0.021, 12, 'iron', axis='y', bevel=0.004).moved(side * x, 0, z)


def arms(side):
    """Upper arm, ball, and the link from the ball down to the sleeve."""
    centre = (side * REACH, 0, BALL_Z)
    upper = tube([(side * 0.038, 0, 0.428), centre], ARM, 10, 'brass')
    lower = tube([(side * 0.034, 0, 0.208), centre], ARM, 10, 'brass')
    cap = cylinder(0.02, BALL_Z - BALL - 0.010, BALL_Z, 12, 'iron', bevel=0.004).moved(side * REACH, 0, 0)
    return [upper, lower, cap, ball(BALL, 20, 12, 'brass').moved(*centre)]
