"""Every part by the name of its node: what makes it, whether it is a rigid body, kilograms, the box that it fills."""
from collections import namedtuple
import fittings
import gate
import governor
import night_stone
import platforms

# low, high: corners of the box in metres, z up; a millimetre is allowed
Entry = namedtuple('Entry', 'name build is_body mass low high')

PARTS = [
    Entry('gate_left', gate.gate_left, True, 80, (-0.042, -0.042, 0.02), (1.30, 0.042, 1.77)),
    Entry('gate_right', gate.gate_right, True, 80, (-1.30, -0.042, 0.02), (0.042, 0.042, 1.77)),
    Entry('gate_post', gate.gate_post, False, None, (-0.13, -0.13, 0.0), (0.13, 0.13, 1.95)),
    Entry('plate', platforms.plate, False, None, (-0.50, -0.50, 0.0), (0.50, 0.50, 0.04)),
    Entry('governor', governor.governor, True, 18, (-0.17, -0.114, 0.0), (0.17, 0.114, 0.50)),
    Entry('valve_wheel', fittings.valve_wheel, True, 12, (-0.23, -0.23, 0.0), (0.23, 0.23, 0.09)),
    Entry('gear_small', fittings.gear_small, True, 16, (-0.20, -0.20, 0.0), (0.20, 0.20, 0.10)),
    Entry('night_stone', night_stone.night_stone, False, None, (-0.15, -0.15, 0.0), (0.15, 0.15, 0.42)),
    Entry('turntable', platforms.turntable, True, 200, (-0.95, -0.95, 0.0), (0.95, 0.95, 0.14)),
    Entry('crate_tool', fittings.crate_tool, True, 8, (-0.20, -0.17, 0.0), (0.20, 0.17, 0.30)),
]
