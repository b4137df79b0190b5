"""Make stone.png, the surface of wet stone: python graphs/textures/stone.py

    height = FFT^-1( white noise / |k|^1.2 ),    shade = 0.7 + 0.1 height - 0.25 exp(-(ridge / 0.12)^2)

It repeats at its borders. `ridge` is smoother noise, whose zeros are the cracks. [after Musgrave, Kolb and Mace 1989]
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

SIZE = 384
"""Texels along a side."""


def noise(seed: int, slope: float, least: float) -> np.ndarray:
    """Return noise (SIZE, SIZE) of mean 0 and deviation 1: amplitudes fall as |k|^-slope from `least` waves on."""
    white = np.fft.fft2(np.random.default_rng(seed).standard_normal((SIZE, SIZE)))
    waves = np.fft.fftfreq(SIZE) * SIZE
    k = np.hypot(waves[:, None], waves[None, :])
    made = np.fft.ifft2(white / np.maximum(k, least) ** slope * (k > 0)).real
    return (made - made.mean()) / made.std()


if __name__ == "__main__":
    shade = 0.7 + 0.1 * noise(1, 1.2, 6) - 0.25 * np.exp(-((noise(2, 1.8, 5) / 0.12) ** 2))
    stone = Image.fromarray(np.round(255 * np.clip(shade, 0.05, 1)).astype(np.uint8))
    stone.quantize(32).convert("L").save(Path(__file__).parent / "stone.png", optimize=True)
