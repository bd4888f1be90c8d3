"""The stairs: one flight up from the nave to the landing, two from there to the galleries."""
from plan import HALF_LENGTH, ARCADE_Y, ARCADE_HALF, RISER, STEPS, LANDING, LANDING_X, LANDING_HALF
from architecture import BALUSTER
from shapes import box, join, lathe, prism, square_lathe, sweep, line_frames


def flight(tread, half_width, foot):
    """Steps up along +x from x = 0, z = `foot` at the first riser's bottom; solid down to the floor. No rails."""
    nose, thick = 0.03, 0.045
    parts = []
    for i in range(STEPS - 1):
        x, z = i * tread, foot + (i + 1) * RISER
        parts.append(box((x - nose, -half_width, z - thick), (x + tread, half_width, z), 'marble', step_tint(i)))
        parts.append(box((x, -half_width + 0.01, -0.05), (x + tread, half_width - 0.01, z - thick), 'stone'))
    x = (STEPS - 1) * tread
    z = foot + STEPS * RISER
    parts.append(box((x - nose, -half_width, z - thick), (x, half_width, z), 'marble', step_tint(0)))
    parts.append(box((x - 0.012, -half_width + 0.01, z - RISER - 0.02), (x, half_width - 0.01, z - thick), 'stone'))
    return join(parts)


def step_tint(i):
    shade = 0.93 + 0.05 * ((i * 5) % 3) / 2
    return (shade, shade * 0.96, shade * 0.90)


def string_and_rail(tread, foot, y):
    """A solid string beside the steps with balusters and a sloping handrail on it."""
    run = (STEPS - 1) * tread
    slope = RISER / tread
    half = 0.12
    top = lambda x: foot + RISER + slope * x + 0.10
    outline = [(-0.12, -0.05), (run + 0.05, -0.05), (run + 0.05, top(run + 0.05)), (-0.12, top(-0.12))]
    string = prism(outline, y - half, y + half, 'ashlar')
    coping = slanted(
        [(-0.14, -0.02), (0.14, -0.02), (0.14, 0.02), (0.11, 0.05), (-0.11, 0.05), (-0.14, 0.02)],
        (-0.1, top(-0.1)),
        (run + 0.04, top(run + 0.04)),
        y,
    )
    lift = 0.66
    rail = slanted(
        [
            (-0.09, 0.0),
            (0.09, 0.0),
            (0.12, 0.04),
            (0.12, 0.08),
            (0.08, 0.12),
            (-0.08, 0.12),
            (-0.12, 0.08),
            (-0.12, 0.04),
        ],
        (-0.05, top(-0.05) + lift),
        (run + 0.05, top(run + 0.05) + lift),
        y,
    )
    parts = [string, coping, rail]
    for i in range(1, STEPS - 1):
        x = (i + 0.0) * tread
        parts.append(
            lathe(BALUSTER, 6, 'stone', phase=0.5, caps=(False, False)).stretched(1, 1, 1.08).moved(x, y, top(x) + 0.01)
        )
    return join(parts)


def slanted(profile, start, stop, y):
    a, b = (start[0], y, start[1]), (stop[0], y, stop[1])
    return sweep(profile, line_frames(a, b), 'stone')


def newel(height):
    """A square post with a moulded cap; lanterns stand on it. Its foot is at the origin."""
    profile = [
        (0.24, -0.05),
        (0.24, 0.16),
        (0.20, 0.21),
        (0.20, height - 0.18),
        (0.225, height - 0.15),
        (0.25, height - 0.08),
        (0.25, height - 0.03),
        (0.22, height),
    ]
    return square_lathe(profile, caps=(False, True))


def stairs():
    """All flights and the landing, in hall coordinates."""
    main_tread, side_tread = 0.30, (ARCADE_Y - ARCADE_HALF - 0.21 - LANDING_HALF) / (STEPS - 1)
    main_x = LANDING_X - (STEPS - 1) * main_tread
    parts = [flight(main_tread, 1.3, 0.0).moved(main_x)]
    for side in (-1, 1):
        parts.append(string_and_rail(main_tread, 0.0, 0.0).moved(main_x, side * 1.40))
        parts.append(newel(1.25).moved(main_x - 0.24, side * 1.40))
        parts.append(newel(LANDING + 1.12).moved(LANDING_X + 0.02, side * 1.40))
    middle = (LANDING_X + HALF_LENGTH) / 2
    half = (HALF_LENGTH - LANDING_X) / 2
    parts.append(
        box((LANDING_X, -LANDING_HALF - 0.01, -0.05), (HALF_LENGTH, LANDING_HALF + 0.01, LANDING - 0.045), 'stone')
    )
    parts.append(
        box((LANDING_X, -LANDING_HALF, LANDING - 0.045), (HALF_LENGTH, LANDING_HALF, LANDING), 'marble', step_tint(1))
    )
    for side in (-1, 1):
        climb = join(
            [flight(side_tread, half, LANDING), string_and_rail(side_tread, LANDING, half if side > 0 else -half)]
        )
        parts.append(climb.turned('z', 90 * side).moved(middle, side * LANDING_HALF))
    return join(parts)
