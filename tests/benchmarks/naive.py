"""What one writes first with Numba: a loop over the particles, everything a substep does in its body, libm's functions.

Arrays and constants are float32 throughout, so nothing is computed in double by mistake.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

ZERO, HALF, ONE, TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
SIXTH = np.float32(1 / 6)


@njit(nogil=True)
def vortex(x, y, z, dt, p):
    """Turn a position about an axis: p holds center, axis, magnitude, tightness, range, lift."""
    ox, oy, oz = x - p[0], y - p[1], z - p[2]
    height = ox * p[3] + oy * p[4] + oz * p[5]
    rx, ry, rz = ox - p[3] * height, oy - p[4] * height, oz - p[5] * height
    R = math.sqrt(rx * rx + ry * ry + rz * rz)
    near = R / p[8]
    if R == ZERO or near >= ONE:
        return x, y, z
    rate = dt * (ONE - near * near) ** 2 * R ** -p[7]
    s, c = math.sin(p[6] * rate), math.cos(p[6] * rate)
    up = height + p[9] * rate
    return (p[0] + p[3] * up + rx * c + (p[4] * rz - p[5] * ry) * s,
            p[1] + p[4] * up + ry * c + (p[5] * rx - p[3] * rz) * s,
            p[2] + p[5] * up + rz * c + (p[3] * ry - p[4] * rx) * s)


@njit(nogil=True)
def bounced(x, y, z, u, v, w, distance, nx, ny, nz, resilience, friction, threshold):
    """Reflect a particle that has passed a surface."""
    if distance >= ZERO:
        return x, y, z, u, v, w
    speed = u * nx + v * ny + w * nz
    slowed = ZERO if math.sqrt(u * u + v * v + w * w) < threshold else friction
    a, b = ONE - slowed, speed * (ONE - slowed + resilience)
    back = distance * TWO
    return x - nx * back, y - ny * back, z - nz * back, u * a - nx * b, v * a - ny * b, w * a - nz * b


@njit(nogil=True)
def ten_substep(first, last, px, py, pz, vx, vy, vz, ax, ay, az, turn_rate, e):
    """One substep of the ten operators; e is laid out as the C struct is."""
    dt = e[64]
    damping = max(ONE - e[3] * dt, ZERO)
    for i in range(first, last):
        x, y, z, u, v, w = px[i], py[i], pz[i], vx[i], vy[i], vz[i]
        bu, bv, bw = u, v, w
        u, v, w = (u + e[0] * dt) * damping, (v + e[1] * dt) * damping, (w + e[2] * dt) * damping
        size = math.sqrt(ax[i] * ax[i] + ay[i] * ay[i] + az[i] * az[i])
        if size > ZERO:
            kx, ky, kz = ax[i] / size, ay[i] / size, az[i] / size
            s, c = math.sin(turn_rate[i] * dt), math.cos(turn_rate[i] * dt)
            along = (kx * u + ky * v + kz * w) * (ONE - c)
            u, v, w = (u * c + (ky * w - kz * v) * s + kx * along, v * c + (kz * u - kx * w) * s + ky * along,
                       w * c + (kx * v - ky * u) * s + kz * along)
        x, y, z = vortex(x, y, z, dt, e[4:14])
        x, y, z = vortex(x, y, z, dt, e[14:24])
        x, y, z = x + (bu + u) * (dt * HALF), y + (bv + v) * (dt * HALF), z + (bw + w) * (dt * HALF)
        distance = (x - e[27]) * e[24] + (y - e[28]) * e[25] + (z - e[29]) * e[26]
        x, y, z, u, v, w = bounced(x, y, z, u, v, w, distance, e[24], e[25], e[26], e[31], e[32], e[33])
        for k in range(34, 64, 10):
            ox, oy, oz = x - e[k + 3], y - e[k + 4], z - e[k + 5]
            R = math.sqrt(ox * ox + oy * oy + oz * oz)
            if R > ZERO:
                x, y, z, u, v, w = bounced(x, y, z, u, v, w, R - e[k + 6], ox / R, oy / R, oz / R, e[k + 7], e[k + 8], e[k + 9])
        px[i], py[i], pz[i], vx[i], vy[i], vz[i] = x, y, z, u, v, w


@njit(nogil=True)
def spin(x, y, z, u, v, w, kx, ky, kz, rate, dt):
    """Turn a velocity about the unit vector k and follow it: a helix."""
    angle = rate * dt
    s, c = math.sin(angle), math.cos(angle)
    along = kx * u + ky * v + kz * w
    if abs(angle) > ZERO:
        wave, bow = s / angle * dt, (ONE - c) / angle * dt
    else:
        wave, bow = dt, ZERO
    tx, ty, tz = ky * w - kz * v, kz * u - kx * w, kx * v - ky * u
    rest = along * (dt - wave)
    x, y, z = x + u * wave + tx * bow + kx * rest, y + v * wave + ty * bow + ky * rest, z + w * wave + tz * bow + kz * rest
    rest = along * (ONE - c)
    return x, y, z, u * c + tx * s + kx * rest, v * c + ty * s + ky * rest, w * c + tz * s + kz * rest


@njit(nogil=True)
def snow_step(first, last, px, py, pz, vx, vy, vz, ax, ay, az, tx, ty, tz, speed, met, e):
    """One frame of snow; e is laid out as the C struct is, the turning rates come from a column."""
    dt, half = e[28], e[29]
    share = (e[32] - e[30]) / (e[31] - e[30])
    for i in range(first, last):
        size = math.sqrt(ax[i] * ax[i] + ay[i] * ay[i] + az[i] * az[i])
        if size == ZERO:
            continue
        kx, ky, kz = ax[i] / size, ay[i] / size, az[i] / size
        x, y, z, u, v, w = spin(px[i], py[i], pz[i], vx[i], vy[i], vz[i], kx, ky, kz, speed[i], half)
        x, y, z = vortex(x, y, z, half, e[0:10])
        x, y, z = vortex(x, y, z, dt, e[10:20])
        x, y, z = vortex(x, y, z, half, e[0:10])
        x, y, z, u, v, w = spin(x, y, z, u, v, w, kx, ky, kz, speed[i], half)
        if (x - e[20]) * e[23] + (y - e[21]) * e[24] + (z - e[22]) * e[25] < ZERO:
            met[i] = 1
            continue
        tx[i], ty[i], tz[i] = px[i] + (x - px[i]) * share, py[i] + (y - py[i]) * share, pz[i] + (z - pz[i]) * share
        px[i], py[i], pz[i], vx[i], vy[i], vz[i] = x, y, z, u, v, w


def run(effect: str, columns: list[np.ndarray], parameters: np.ndarray, first: int, last: int) -> Any:
    """Advance particles first to last by a frame."""
    if effect == "ten_operators":
        for _ in range(4):
            ten_substep(first, last, *columns[:10], parameters)
    else:
        snow_step(first, last, *columns[:13], columns[14], parameters)
