"""Small pictures that tests keep beside them.

A picture is as kept if no pixel differs by more than one level of 255: processors may round a last bit differently, which
can bring a value over the edge between two levels, and never further.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from PIL import Image

LEVELS = 1
LARGEST = 30_000
"""Bytes that a picture may take."""


def pixels(file: Path) -> np.ndarray:
    """Return the picture of a file: bytes of sRGB (height, width, 3)."""
    with Image.open(file) as picture:
        return np.asarray(picture.convert("RGB"))


def is_as_kept(picture: np.ndarray, file: Path) -> bool:
    """Return whether a picture is as its file, to one level."""
    wanted = pixels(file)
    return picture.shape == wanted.shape and bool(np.abs(picture.astype(int) - wanted).max() <= LEVELS)


def keep(folder: Path, pictures: Mapping[str, np.ndarray]) -> None:
    """Write pictures by their names, without the suffix, and say how large they are."""
    for name, picture in pictures.items():
        file = folder / f"{name}.png"
        Image.fromarray(picture).save(file, optimize=True)
        print(f"{file.name}: {picture.shape[1]} x {picture.shape[0]}, {file.stat().st_size:,} bytes")


def forget(folder: Path, pattern: str = "*.png") -> None:
    """Remove the pictures that are kept in a folder."""
    for file in folder.glob(pattern):
        file.unlink()


def faults_of_kept(folder: Path, names: set[str]) -> list[str]:
    """Return what is wrong with the files of a folder: pictures of nothing, pictures that are missing, large ones."""
    there = {file.stem: file.stat().st_size for file in folder.glob("*.png")}
    return [*(f"{name}: a picture of nothing" for name in sorted(there.keys() - names)),
            *(f"{name}: no picture is kept" for name in sorted(names - there.keys())),
            *(f"{name}: {size:,} bytes" for name, size in sorted(there.items()) if size >= LARGEST)]
