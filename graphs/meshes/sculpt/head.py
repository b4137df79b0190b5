"""A head in the manner of a Greek youth, looking along +z: chin at -1 m, crown at 1 m, a neck that ends at -1.5 m.

Proportions are those of the schools: eyes half way up, the face in thirds from the hairline over brow and nose to the chin,
an eye's width between the eyes.
"""

from __future__ import annotations

import numpy as np
from clay import Distance, Points, ball, common, cut, ellipsoid, join, limb, mirrored, near, smooth_path, swell, tube
from hair import hair
from surface import Focus

LOW, HIGH = (-1.05, -1.6, -1.3), (1.05, 1.25, 1.2)
STEP, COUNT, DIGITS = 0.0095, 44000, 3
FOCUS = Focus((0.0, -0.15, 0.65), 0.5, 1.2)
EYE = (0.265, 0.005, 0.515)
EYEBALL = 0.165


def distance(points: Points) -> Distance:
    """Return the signed distance from the head, near its surface [m]."""
    p = mirrored(points, 0.015)
    head = join(0.06, cut(0.03, skull(p), sockets(p)), nose(p))
    head = head - strokes(p)
    head = around(p, EYE, 0.42, head, eye)
    head = around(p, (0, -0.55, 0.68), 0.45, head, mouth)
    head = join(0.03, head, near(p, (0.62, -0.1, -0.07), 0.45, ear))
    head = join(0.02, head, hair(points))
    return common(0.04, head, -1.5 - points[:, 1])


def skull(p: Points) -> Distance:
    """Return the forms under the skin: cranium, cheeks, jaw, chin and neck."""
    cranium = ellipsoid(p, (0, 0.27, -0.14), (0.655, 0.70, 0.83))
    brow = ellipsoid(p, (0, 0.20, 0.10), (0.555, 0.52, 0.60))
    face = ellipsoid(p, (0, -0.30, 0.22), (0.47, 0.62, 0.49))
    cheek = ellipsoid(p, (0.33, -0.20, 0.36), (0.21, 0.19, 0.21))
    flesh = ellipsoid(p, (0.24, -0.46, 0.36), (0.22, 0.28, 0.27))
    edge = [(0.43, -0.25, -0.02), (0.365, -0.56, 0.08), (0.12, -0.83, 0.50), (0, -0.84, 0.56)]
    jaw = tube(p, edge, [0.10, 0.11, 0.12, 0.12], 0.05)
    muzzle = ellipsoid(p, (0, -0.53, 0.42), (0.26, 0.30, 0.35))
    chin = ellipsoid(p, (0, -0.83, 0.59), (0.12, 0.12, 0.14))
    nape = limb(p, (0, -0.30, -0.34), (0, -1.60, -0.40), 0.36, 0.42)
    throat = limb(p, (0, -0.8, -0.10), (0, -1.7, -0.22), 0.29, 0.38)
    head = join(0.12, cranium, brow)
    head = join(0.15, head, face, jaw)
    head = join(0.14, head, cheek, flesh)
    head = join(0.14, head, muzzle)
    head = join(0.12, head, chin)
    strap = limb(p, (0.50, -0.30, -0.24), (0.06, -1.56, 0.12), 0.07, 0.08)
    return join(0.14, join(0.12, head, join(0.1, nape, throat)), strap)


def sockets(p: Points) -> Distance:
    """Return the hollows under the brow in which the eyes lie."""
    return ellipsoid(p, (0.255, -0.01, 0.75), (0.185, 0.105, 0.16), (1, 14))


def nose(p: Points) -> Distance:
    """Return the nose: straight from the brow, with wings and nostrils."""
    bridge = tube(p, [(0, 0.20, 0.63), (0, 0.03, 0.695), (0, -0.26, 0.855)], [0.08, 0.062, 0.076], 0.03)
    tip = ellipsoid(p, (0, -0.27, 0.855), (0.075, 0.07, 0.085))
    base = ellipsoid(p, (0, -0.30, 0.76), (0.10, 0.07, 0.12))
    wing = ellipsoid(p, (0.098, -0.305, 0.765), (0.045, 0.055, 0.08), (1, 20))
    whole = join(0.06, join(0.06, bridge, tip), base)
    whole = join(0.04, whole, wing)
    return cut(0.02, whole, ellipsoid(p, (0.052, -0.375, 0.80), (0.026, 0.03, 0.05), (1, 18)))


def strokes(p: Points) -> Distance:
    """Return what the thumb adds to the surface, and takes from it [m]."""
    raised = 0.03 * swell(p, (0.24, 0.15, 0.66), (0.2, 0.05, 0.15), (2, -6))
    raised += 0.02 * swell(p, (0, 0.15, 0.7), (0.1, 0.08, 0.2))
    raised += 0.015 * swell(p, (0.10, -0.90, 0.66), (0.08, 0.08, 0.12))
    dents = 0.012 * swell(p, (0.40, -0.46, 0.42), (0.13, 0.2, 0.2))
    dents += 0.025 * swell(p, (0, -0.715, 0.76), (0.16, 0.05, 0.12))
    dents += 0.016 * swell(p, (0, -0.435, 0.78), (0.028, 0.05, 0.1))
    dents += 0.02 * swell(p, (0.60, 0.22, 0.25), (0.1, 0.2, 0.2))
    dents += 0.010 * swell(p, (0.19, -0.41, 0.68), (0.045, 0.1, 0.1), (2, 25))
    return raised - dents


def around(p: Points, center: tuple, reach: float, head: Distance, change) -> Distance:
    """Return the head, changed within reach of a center."""
    close = ((p - np.float32(center)) ** 2).sum(axis=1) < reach * reach
    result = head.copy()
    if close.any():
        result[close] = change(p[close], head[close])
    return result


def rim(across: np.ndarray, height: float) -> np.ndarray:
    """Return the points of a lid's rim: an arc of so much height, on the ball of the eye."""
    x = 0.145 * across - 0.01
    y = height * (1 - across**2) ** 0.8 + 0.10 * x - 0.008
    radius = EYEBALL + 0.012
    return np.float32(EYE) + np.column_stack([x, y, np.sqrt(radius * radius - x * x - y * y)])


def eye(p: Points, head: Distance) -> Distance:
    """Return the head about one eye: a ball, over it lids with an almond cut out, a fold over the upper one."""
    q = p - np.float32(EYE)
    across = np.clip((q[:, 0] + 0.01) / 0.145, -1, 1)
    arc = (1 - across**2) ** 0.8
    level = q[:, 1] - 0.10 * q[:, 0] + 0.008
    opening = np.maximum(np.maximum(level - 0.076 * arc, -0.046 * arc - level), -q[:, 2])
    opening = np.maximum(opening, np.abs(q[:, 0] + 0.01) - 0.145)
    head = cut(0.01, join(0.04, head, ball(p, EYE, EYEBALL + 0.016)), opening)
    way = np.linspace(-1, 1, 17)
    upper, lower = rim(way, 0.076), rim(way, -0.046)
    thick = 0.010 + 0.010 * (1 - way**2) ** 0.5
    head = join(0.012, head, tube(p, upper, thick + 0.004), tube(p, lower, thick))
    fold = [(0.115, 0.085, 0.70), (0.20, 0.125, 0.705), (0.32, 0.125, 0.655), (0.43, 0.065, 0.555)]
    head = join(0.07, head, tube(p, smooth_path(fold, 9), [0.008, 0.016, 0.022, 0.026, 0.03, 0.032, 0.03, 0.024, 0.014]))
    return join(0.004, head, ball(p, EYE, EYEBALL))


def mouth(p: Points, head: Distance) -> Distance:
    """Return the head about the mouth: lips bent around the teeth, a line between them, corners sunk."""
    q = p.copy()
    q[:, 2] += 0.9 * p[:, 0] ** 2
    upper = [(0, -0.515, 0.762), (0.05, -0.504, 0.764), (0.13, -0.528, 0.745), (0.21, -0.556, 0.72)]
    lower = [(0, -0.600, 0.742), (0.06, -0.599, 0.742), (0.13, -0.586, 0.732), (0.195, -0.562, 0.715)]
    line = [(0, -0.557, 0.806), (0.06, -0.551, 0.80), (0.14, -0.557, 0.775), (0.22, -0.560, 0.745)]
    head = join(0.03, head, tube(q, upper, [0.032, 0.034, 0.026, 0.008]))
    head = join(0.03, head, tube(q, lower, [0.046, 0.045, 0.034, 0.010]))
    head = head + 0.008 * swell(p, (0.235, -0.565, 0.66), (0.035, 0.04, 0.1))
    return cut(0.02, head, tube(q, line, [0.009, 0.009, 0.010, 0.012]))


def ear(p: Points) -> Distance:
    """Return an ear: a rim about a hollow, a fold in it, and a lobe."""
    path = [(0.58, -0.10, 0.03), (0.64, 0.05, 0.04), (0.69, 0.13, -0.06), (0.71, 0.06, -0.17), (0.69, -0.12, -0.18),
            (0.63, -0.27, -0.09), (0.58, -0.32, -0.02)]
    helix = tube(p, smooth_path(path, 40), smooth_path([[0.022], [0.03], [0.032], [0.032], [0.03], [0.04], [0.034]], 40)[:, 0])
    shell = ellipsoid(p, (0.61, -0.08, -0.07), (0.06, 0.22, 0.13), (1, -18))
    fold = tube(p, smooth_path([(0.67, 0.06, -0.06), (0.67, -0.06, -0.12), (0.64, -0.22, -0.05)], 16), [0.022] * 16)
    flap = ellipsoid(p, (0.60, -0.14, 0.03), (0.03, 0.06, 0.04))
    whole = join(0.02, join(0.03, shell, helix), fold, flap)
    return cut(0.02, whole, ellipsoid(p, (0.68, -0.12, -0.035), (0.07, 0.075, 0.05)))
