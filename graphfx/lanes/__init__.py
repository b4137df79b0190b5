"""Explicit vectors for Numba: sixteen float32 or eight float64 lanes, masks, loads and stores."""

from graphfx.lanes.compile import compiled, inlined, register
from graphfx.lanes.memory import any_lane, highest, iota, load, lowest, mask_bits, mask_from_bits, splat, store
from graphfx.lanes.types import Mask, Real, Vec3Type, Word

__all__ = [
    "Mask", "Real", "Vec3Type", "Word", "any_lane", "compiled", "highest", "inlined", "iota", "load", "lowest", "mask_bits",
    "mask_from_bits", "register", "splat", "store",
]
