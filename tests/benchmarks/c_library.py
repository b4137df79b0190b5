"""Build the C side of the benchmark with gcc into a folder, and call it."""

from __future__ import annotations

import ctypes
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
COMMON = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math", "-fopenmp-simd", "-fPIC", "-shared")
"""No errno and no traps: neither changes a number, and without them gcc makes no vectors of sqrtf and of choices."""


@dataclass(frozen=True)
class Build:
    """One way to compile: how the loops are cut, how wide, and what the compiler may do with the arithmetic."""

    effect: str
    form: int
    width: int
    contract: str = "off"
    fast: bool = False
    draw: int = 1

    @property
    def flags(self) -> tuple[str, ...]:
        """Return what gcc is told."""
        fast = ("-ffast-math",) if self.fast else ()
        return (*COMMON, f"-mprefer-vector-width={self.width}", *fast, f"-ffp-contract={self.contract}",
                f"-DFORM={self.form}", f"-DDRAW={self.draw}")

    def __str__(self) -> str:
        """Say it in a few words."""
        loops = ("all substeps in one loop", "one loop a substep", "one loop an operator")[self.form]
        return f"{loops}, {self.width} bits, contract {self.contract}{', fast-math' if self.fast else ''}"


class Library:
    """A compiled effect."""

    def __init__(self, build: Build, folder: Path):
        self.build = build
        file = folder / f"{build.effect}_{abs(hash(build)):x}.so"
        subprocess.run(["gcc", *build.flags, str(HERE / f"{build.effect}.c"), "-o", str(file), "-lm"], check=True)
        self._run = ctypes.CDLL(str(file)).run
        self._run.argtypes = [ctypes.c_void_p, ctypes.c_long, ctypes.c_long, ctypes.c_void_p]

    def run(self, columns: list[np.ndarray], parameters: np.ndarray, first: int, last: int) -> None:
        """Advance particles first to last by a frame; ctypes lets go of the interpreter's lock."""
        addresses = (ctypes.c_void_p * len(columns))(*(column.ctypes.data for column in columns))
        self._run(ctypes.addressof(addresses), first, last, parameters.ctypes.data)


def builds(effect: str, draw: int = 1) -> list[Build]:
    """Return the honest ways to compile an effect: the fastest counts."""
    forms = (0, 1, 2) if effect == "ten_operators" else (1, 2)
    return [Build(effect, form, width, contract, False, draw)
            for form in forms for width in (256, 512) for contract in ("off", "fast")]
