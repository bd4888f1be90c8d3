"""Tileable pictures from numpy: colour and height fields, seeded, no files read."""
import numpy as np


def noise(rng, size, cells):
    """Smooth periodic noise in [0, 1]: random values on a cells x cells torus, cubic steps in between."""
    cells_y, cells_x = cells if isinstance(cells, tuple) else (cells, cells)
    grid = rng.random((cells_y, cells_x))

    def weights(n, count):
        t = np.arange(n) * count / n
        i = np.floor(t).astype(int)
        f = t - i
        return i % count, (i + 1) % count, f * f * (3 - 2 * f)

    y0, y1, fy = weights(size[0], cells_y)
    x0, x1, fx = weights(size[1], cells_x)
    fy, fx = fy[:, None], fx[None, :]
    top = grid[y0][:, x0] * (1 - fx) + grid[y0][:, x1] * fx
    bottom = grid[y1][:, x0] * (1 - fx) + grid[y1][:, x1] * fx
    return top * (1 - fy) + bottom * fy


def clouds(rng, size, cells, octaves=5, gain=0.55):
    """Octaves of noise, in [0, 1] about 0.5."""
    cells_y, cells_x = cells if isinstance(cells, tuple) else (cells, cells)
    total, weight, sum_weight = np.zeros(size), 1.0, 0.0
    for _ in range(octaves):
        total += weight * noise(rng, size, (min(cells_y, size[0]), min(cells_x, size[1])))
        sum_weight += weight
        weight *= gain
        cells_y, cells_x = cells_y * 2, cells_x * 2
    return total / sum_weight


def step(x, lo, hi):
    t = np.clip((x - lo) / (hi - lo), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    """Between two colours (or a picture and a colour) by a field."""
    return np.asarray(a) * (1 - t[..., None]) + np.asarray(b) * t[..., None]


def normal_map(height, metres):
    """Tangent-space normals, +y up, of a height field in metres that covers `metres` (u, v); row 0 is the bottom."""
    rows, columns = height.shape
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * columns / (2 * metres[0])
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * rows / (2 * metres[1])
    n = np.stack([-dx, -dy, np.ones_like(dx)], -1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True) * 0.5 + 0.5


def plaster(rng, size):
    """Lime plaster: soft clouds, faint trowel marks. Returns linear colour and height (m) for 4 x 4 m."""
    broad, fine = clouds(rng, size, 3), clouds(rng, size, 24, 4)
    trowel = clouds(rng, size, (40, 8), 3)
    colour = mix((0.84, 0.77, 0.66), (0.74, 0.655, 0.53), step(broad, 0.30, 0.75))
    colour = colour * (0.94 + 0.12 * fine)[..., None]
    return colour, 0.004 * fine + 0.006 * trowel


def ashlar(rng, size):
    """Stone blocks, four courses of two staggered blocks on 2 x 2 m, with narrow joints."""
    rows, columns = size
    v, u = np.meshgrid(np.arange(rows) / rows * 4, np.arange(columns) / columns * 2, indexing='ij')
    course = np.floor(v).astype(int)
    shifted = (u + 0.5 * (course % 2)) % 2
    block = course * 2 + np.floor(shifted).astype(int)
    edge_u = np.minimum(shifted % 1, 1 - shifted % 1) * 1.0
    edge_v = np.minimum(v % 1, 1 - v % 1) * 0.5
    joint = 1 - step(np.minimum(edge_u, edge_v), 0.006, 0.016)
    shade = rng.random(8)[block]
    grain, spots = clouds(rng, size, 8), clouds(rng, size, 40, 3)
    colour = mix((0.80, 0.70, 0.53), (0.66, 0.53, 0.365), step(0.5 * shade + 0.5 * grain, 0.2, 0.8))
    colour = colour * (0.90 + 0.2 * spots)[..., None]
    colour = mix(colour, (0.50, 0.435, 0.345), 0.7 * joint)
    return colour, 0.006 * (1 - joint) + 0.004 * grain + 0.0025 * spots


def limestone(rng, size):
    """Smooth dressed stone, 2 x 2 m."""
    broad, grain, spots = clouds(rng, size, 3), clouds(rng, size, 16, 5), clouds(rng, size, 64, 2)
    colour = mix((0.83, 0.76, 0.63), (0.71, 0.62, 0.475), step(0.6 * broad + 0.4 * grain, 0.3, 0.7))
    colour = mix(colour, (0.52, 0.45, 0.36), 0.35 * step(spots, 0.68, 0.85))
    return colour, 0.003 * grain + 0.0012 * spots


def marble(rng, size):
    """Veined floor stone, nearly white: tiles are tinted by their corner colours. 2 x 2 m."""
    broad, warp = clouds(rng, size, 4), clouds(rng, size, 6, 5)
    vein = 1 - np.abs(2 * clouds(rng, size, 5, 5, 0.6) - 1)
    vein = step(vein, 0.90, 1.0) * step(warp, 0.35, 0.6)
    colour = mix((0.86, 0.83, 0.78), (0.70, 0.655, 0.595), step(0.5 * broad + 0.5 * warp, 0.3, 0.7))
    return mix(colour, (0.5, 0.44, 0.38), 0.55 * vein), 0.0008 * warp - 0.0008 * vein


def wood(rng, size):
    """Oiled boards' grain along u, 1 x 0.5 m; boards are tinted by their corner colours."""
    rows, columns = size
    wave = clouds(rng, size, (4, 2), 3)
    v = np.arange(rows)[:, None] / rows
    bands = 0.5 + 0.5 * np.sin(2 * np.pi * (15 * v + 2.6 * wave))
    fibre = clouds(rng, size, (96, 3), 3)
    tone = 0.30 * bands + 0.70 * fibre
    colour = mix((0.60, 0.395, 0.215), (0.37, 0.215, 0.105), step(tone, 0.15, 0.9))
    pore = step(clouds(rng, size, (128, 6), 2), 0.62, 0.8)
    return colour * (1 - 0.35 * pore)[..., None], 0.0015 * tone - 0.0015 * pore


def paint(rng, size, colour, rust=0.36):
    """Painted steel with chips and rust. Returns colour, height, and roughness and metalness fields."""
    broad, chips = clouds(rng, size, 4), clouds(rng, size, 14, 5, 0.62)
    worn = step(0.45 * broad + 0.55 * chips, 0.66 - 0.26 * rust, 0.70 - 0.26 * rust)
    edge = step(0.45 * broad + 0.55 * chips, 0.62 - 0.26 * rust, 0.66 - 0.26 * rust) - worn
    base = np.array(colour) * (0.82 + 0.36 * clouds(rng, size, 6, 4))[..., None]
    rust_colour = mix((0.33, 0.135, 0.05), (0.17, 0.07, 0.035), clouds(rng, size, 32, 3))
    picture = mix(base, np.array(colour) * 1.45 + 0.03, 0.6 * np.clip(edge, 0, 1))
    picture = picture * (1 - worn[..., None]) + rust_colour * worn[..., None]
    height = 0.0006 * (1 - worn) + 0.0009 * worn * clouds(rng, size, 48, 3) + 0.0012 * broad
    return picture, height, 0.38 + 0.12 * broad + 0.42 * worn, 0.15 * (1 - worn)


def metal(rng, size, bright, dull):
    """Bare metal with stains: colour, height, roughness, metalness."""
    stain, scratch = clouds(rng, size, 6, 5), clouds(rng, size, (96, 4), 2)
    t = step(0.7 * stain + 0.3 * scratch, 0.35, 0.7)
    return mix(bright, dull, t), 0.0006 * stain + 0.0003 * scratch, 0.30 + 0.35 * t, 1.0 - 0.25 * t


def cloth(rng, size):
    """Sacking, 0.25 x 0.25 m: a plain weave."""
    rows, columns = size
    v, u = np.meshgrid(np.arange(rows) / rows * 24, np.arange(columns) / columns * 24, indexing='ij')
    over = (np.floor(u) + np.floor(v)) % 2
    thread = np.where(over > 0, np.sin(np.pi * (u % 1)), np.sin(np.pi * (v % 1)))
    tone = clouds(rng, size, 8)
    colour = mix((0.42, 0.32, 0.19), (0.66, 0.545, 0.37), 0.6 * thread + 0.4 * tone)
    return colour, 0.0022 * thread
