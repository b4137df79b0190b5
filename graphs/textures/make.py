"""Make the maps of this folder: python graphs/textures/make.py [FOLDER]

    fractal noise(k) = FFT^-1( white noise / |k|^slope ),    bent: f(x + strength n(x)),  n two other noises

All are made of such noise, which repeats at the borders, bent by itself until it looks like gas [Quilez 2002, Domain warping].
`gas` glows, `veil` is thin and drawn out, `pillars` are dark columns lit at the edges that look to a star over them, `star` is a
bright point with the four spikes that a telescope's mirror holder makes. What is named `opacity` is grey: white hides.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

HERE = Path(__file__).parent
SIZE = 896
"""Texels along a side."""


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    """0 up to low, 1 from high, between them 3 t^2 - 2 t^3."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def fractal(seed: int, slope: float = 1.9, least: float = 2.0) -> np.ndarray:
    """Return noise (SIZE, SIZE) of mean 0 and deviation 1 that repeats: amplitudes fall as |k|^-slope from `least` waves on."""
    white = np.fft.fft2(np.random.default_rng(seed).standard_normal((SIZE, SIZE)))
    waves = np.fft.fftfreq(SIZE) * SIZE
    k = np.hypot(waves[:, None], waves[None, :])
    noise = np.fft.ifft2(white / np.maximum(k, least) ** slope * (k > 0)).real
    return (noise - noise.mean()) / noise.std()


def at(picture: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a picture that repeats, at x and y in texels, by bilinear interpolation."""
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    u, v = x - i, y - j
    i, j, right, lower = i % SIZE, j % SIZE, (i + 1) % SIZE, (j + 1) % SIZE
    upper_row = picture[j, i] * (1 - u) + picture[j, right] * u
    lower_row = picture[lower, i] * (1 - u) + picture[lower, right] * u
    return upper_row * (1 - v) + lower_row * v


ROWS, COLUMNS = np.mgrid[0:SIZE, 0:SIZE].astype(float)
X, Y = (COLUMNS + 0.5) / SIZE, 1 - (ROWS + 0.5) / SIZE
"""Places from 0 to 1; y goes up."""


def bent(seed: int, strength: float, slope: float = 1.9, stretch: float = 1.0) -> np.ndarray:
    """Return noise bent twice, up to `strength` texels each time; `stretch` draws it out along a slant."""
    x, y = COLUMNS, ROWS
    for step in (1, 2):
        x = x + strength * fractal(seed + 10 * step, 2.2)
        y = y + strength / stretch * fractal(seed + 10 * step + 1, 2.2)
    return at(fractal(seed, slope), x, y)


def rounded(seed: int, reach: float) -> np.ndarray:
    """Return 1 in the middle and 0 well before the borders, with ragged edges, so that no sheet shows where it ends."""
    distance = np.hypot(X - 0.5, Y - 0.5) + 0.06 * fractal(seed, 2.4)
    border = np.maximum(abs(X - 0.5), abs(Y - 0.5))
    inside = 1 - smoothstep(0.3, 0.46, border + 0.05 * fractal(seed + 1, 2.2))
    return smoothstep(reach, reach - 0.3, distance) * inside * (1 - smoothstep(0.44, 0.49, border))


def colored(t: np.ndarray, points: list[tuple[float, tuple[float, float, float]]]) -> np.ndarray:
    """Return linear colours (..., 3) of t by straight lines between points (t, colour)."""
    places = [place for place, _ in points]
    return np.stack([np.interp(t, places, [color[part] for _, color in points]) for part in range(3)], -1)


def gas() -> tuple[np.ndarray, np.ndarray]:
    """Return the colours and the opacity of glowing gas: blue where it is thin, golden where thick, with darker folds."""
    density = bent(1, 42)
    folds = 1 - np.clip(np.abs(bent(5, 60, 1.8)) / 1.1, 0, 1)
    warm = 0.5 + 0.22 * fractal(9, 2.6) + 0.16 * density
    color = colored(warm, [(0, (0.01, 0.05, 0.13)), (0.3, (0.03, 0.22, 0.3)), (0.52, (0.34, 0.22, 0.2)),
                           (0.75, (0.9, 0.36, 0.12)), (1, (1.0, 0.72, 0.42))])
    light = 0.25 + 0.75 * smoothstep(-1.6, 2.2, density + 0.9 * folds)
    opacity = smoothstep(-1.3, 2.1, density + 0.8 * folds) * rounded(31, 0.52)
    return color * light[..., None], opacity


def veil() -> np.ndarray:
    """Return the opacity of thin gas in drawn out folds."""
    folds = 1 - np.clip(np.abs(bent(51, 80, 1.75, 2.5)), 0, 1)
    return folds**2.5 * smoothstep(-0.9, 1.6, bent(57, 40)) * rounded(58, 0.5)


COLUMNS_OF_DUST = ((0.27, 0.88, 0.05, 0.075), (0.47, 0.68, 0.06, 0.062), (0.66, 0.5, 0.07, 0.06), (0.85, 0.36, 0.06, 0.08))
"""Of each: where it stands, how high its head is, how far it leans, half its width."""


def inside() -> np.ndarray:
    """Return how deep each place is in the pillars, in heights of the picture; less than 0 outside."""
    x = X + 0.02 * fractal(71, 2.2, 5) + 0.007 * fractal(72, 1.9, 14)
    y = Y + 0.03 * fractal(73, 2.2, 5)
    depth = 0.2 + 0.03 * fractal(74, 2.5) - y - 0.1 * (x - 0.5)
    for foot, top, lean, width in COLUMNS_OF_DUST:
        middle = foot + lean * y + 0.012 * np.sin(9 * y + 20 * foot)
        head = np.clip((top - y) / (1.1 * width), 0, 1)
        taper = 0.55 + 0.75 * np.clip(1 - y / top, 0, 1) ** 1.4 + 0.12 * np.sin(17 * y + 31 * foot)
        half = width * np.sqrt(head * (2 - head)) * taper
        column = np.where(y < top, half - abs(x - middle), top - y - abs(x - middle))
        near = np.maximum(0.03 - abs(depth - column), 0)
        depth = np.maximum(depth, column) + near * near / 0.12
    return depth + 0.007 * bent(75, 40, 2.0)


def pillars() -> tuple[np.ndarray, np.ndarray]:
    """Return the colours and the opacity of columns of dust: dark, and bright where their edges look up and to the left."""
    depth = inside()
    relief = 0.05 * (1 - np.exp(-np.maximum(depth, 0) / 0.03)) + 0.012 * abs(fractal(81, 2.1, 6)) + 0.004 * fractal(82, 2.3, 10)
    down, right = np.gradient(relief, 1 / SIZE)
    facing = (0.45 * right + 0.89 * down) / np.sqrt(down**2 + right**2 + 0.5)
    toward = np.clip(facing, 0, 1)
    rim = np.exp(-np.maximum(depth, 0) / 0.005) * (0.12 + 0.88 * toward)
    flank = np.exp(-np.maximum(depth, 0) / 0.03) * toward**1.5
    color = np.array((0.008, 0.005, 0.005)) + np.array((0.016, 0.009, 0.008)) * np.clip(facing + 0.1, 0, 1)[..., None]
    color = color + rim[..., None] * np.array((1.0, 0.66, 0.36)) + flank[..., None] * np.array((0.5, 0.17, 0.06)) * 0.4
    haze = np.exp(np.minimum(depth, 0) / 0.03) * 0.07
    color = np.where((depth < 0)[..., None], np.array((0.4, 0.5, 0.5)), color)
    solid = smoothstep(-0.004, 0.008 + 0.012 * smoothstep(-1, 2, fractal(93, 2.2, 5)), depth)
    sides = smoothstep(0.0, 0.16, X + 0.03 * fractal(91, 2.2)) * smoothstep(1.0, 0.84, X + 0.03 * fractal(92, 2.2))
    sides = sides * smoothstep(0.49, 0.46, abs(X - 0.5))
    return np.clip(color, 0, 1), np.maximum(solid, haze) * sides * smoothstep(0.01, 0.1, Y)


def star() -> np.ndarray:
    """Return the light of a star through a telescope, as an opacity: a core, a halo, and four thin spikes."""
    x, y = (np.mgrid[0:256, 0:256] + 0.5) / 128 - 1
    distance = np.hypot(x, y)
    spikes = sum(np.exp(-abs(a) / 0.012) * np.exp(-abs(b) / 0.25) for a, b in ((x, y), (y, x)))
    light = np.exp(-((distance / 0.035) ** 2)) + 0.3 * np.exp(-distance / 0.09) + 0.55 * spikes
    return np.clip(light, 0, 1) * smoothstep(1, 0.6, distance)


def save(picture: np.ndarray, path: Path, linear: bool) -> None:
    """Write a picture as JPEG; light goes to sRGB, opacity stays as it is."""
    if linear:
        picture = np.where(picture < 0.0031308, 12.92 * picture, 1.055 * np.maximum(picture, 0.0031308) ** (1 / 2.4) - 0.055)
    Image.fromarray((np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8)).save(path, quality=80, optimize=True)


def main(folder: Path) -> None:
    """Write all maps."""
    for name, (color, opacity) in {"gas": gas(), "pillars": pillars()}.items():
        save(color, folder / f"{name}.jpg", True)
        save(opacity, folder / f"{name}_opacity.jpg", False)
    save(veil(), folder / "veil_opacity.jpg", False)
    save(star(), folder / "star_opacity.jpg", False)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
