"""Run the benchmark's Taichi side in an interpreter of its own, which need not share this one's packages."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

WORKER = Path(__file__).resolve().parent / "taichi_worker.py"


class TaichiSide:
    """A process that holds the particles in Taichi fields and advances them when told."""

    name = "Taichi"

    def __init__(self, python: str, effect: str, columns: list[np.ndarray], threads: int):
        self._folder = tempfile.TemporaryDirectory()
        np.savez(self._file(), *columns)
        self._process = subprocess.Popen([python, str(WORKER), effect, str(threads), self._file()], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, text=True)
        self.reset(columns)

    def _ask(self, **order: Any) -> Any:
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(json.dumps(order) + "\n")
        self._process.stdin.flush()
        for line in self._process.stdout:
            if line.startswith("{"):
                return json.loads(line)
        raise RuntimeError("the Taichi process has ended")

    def _file(self) -> str:
        return str(Path(self._folder.name) / "columns.npz")

    def reset(self, columns: list[np.ndarray]) -> None:
        """Hand over all columns."""
        np.savez(self._file(), *columns)
        self._ask(do="load", file=self._file())

    def advance(self, parameters: np.ndarray) -> tuple[float, float]:
        """Advance all particles by a frame; return CPU and wall seconds, as the process measures them."""
        answer = self._ask(do="advance", parameters=[float(number) for number in parameters])
        return answer["cpu"], answer["wall"]

    def state(self) -> list[np.ndarray]:
        """Return positions and velocities."""
        self._ask(do="save", file=self._file())
        with np.load(self._file()) as columns:
            return [columns[name] for name in columns.files]
