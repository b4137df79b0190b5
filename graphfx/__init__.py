"""graphfx: particle effects as node graphs, cooked headless, exactly and fast."""

from __future__ import annotations

from typing import Any

__version__ = "0.1.0"
__all__ = ["Graph", "__version__", "load"]


def __getattr__(name: str) -> Any:
    """Import what is asked for only then: `import graphfx` alone loads neither NumPy nor Numba."""
    if name == "load":
        from graphfx.cook.effect import load

        return load
    if name == "Graph":
        from graphfx.authoring import Graph

        return Graph
    raise AttributeError(f"module 'graphfx' has no attribute '{name}'")
