"""Write pool.png beside this file: a round pool of light, or of shade, 1 in the middle and 0 from the border on.

    1 - 3 r^2 + 2 r^3, squared,    r = distance from the middle over half the width, at most 1
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

SIZE = 128


def pool(size: int) -> np.ndarray:
    """Return the picture (size, size), 16 bits of grey."""
    line = (np.arange(size) + 0.5) / size * 2 - 1
    r = np.minimum(np.hypot(line[:, None], line), 1.0)
    return np.round(65535 * (1 - r * r * (3 - 2 * r)) ** 2).astype(np.uint16)


if __name__ == "__main__":
    Image.fromarray(pool(SIZE)).save(Path(__file__).with_suffix(".png"), optimize=True)
