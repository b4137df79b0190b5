"""A tree of boxes about triangles, laid out so that it is walked without a stack.

All triangles are halved again and again, at the median of their centers along the longest side of the box of these,
all boxes of a level at once. Boxes lie in the order of a walk that goes down first; each says where to go on if the
walk passes it over. [Smits 1998, Efficiency issues for ray tracing]
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LEAF = 4
"""Triangles of a leaf, at most."""


@dataclass(frozen=True)
class Tree:
    """Boxes as (center, half size) (n, 6); links as (where to go on, first triangle, number of triangles) (n, 3).

    `order` lists the triangles as the leaves take them. Only leaves have triangles.
    """

    boxes: np.ndarray
    links: np.ndarray
    order: np.ndarray

    @classmethod
    def of(cls, corners: np.ndarray) -> Tree:
        """Build the tree of triangles (m, 3 corners, 3)."""
        low, high = corners.min(axis=1), corners.max(axis=1)
        count = len(corners)
        depth = max(int(np.ceil(np.log2(count / LEAF))), 0)
        order = _halved((low + high) / 2, depth)
        borders = _borders(count, depth)
        levels = [(np.minimum.reduceat(low[order], borders[:-1]), np.maximum.reduceat(high[order], borders[:-1]))]
        for _ in range(depth):
            least, most = levels[0]
            levels.insert(0, (np.minimum(least[::2], least[1::2]), np.maximum(most[::2], most[1::2])))
        boxes, links = np.zeros((2 ** (depth + 1) - 1, 6)), np.zeros((2 ** (depth + 1) - 1, 3), np.int32)
        place = np.zeros(1, np.int64)
        for level, (least, most) in enumerate(levels):
            below = 2 ** (depth - level) - 1
            boxes[place, :3], boxes[place, 3:] = (least + most) / 2, (most - least) / 2
            links[place, 0] = place + 2 * below + 1
            if level == depth:
                links[place, 1], links[place, 2] = borders[:-1], np.diff(borders)
            place = np.stack([place + 1, place + below + 1], axis=1).ravel()
        return cls(boxes, links, order)


def _borders(count: int, level: int) -> np.ndarray:
    """Return where each of 2^level parts of a row begins, and its end."""
    return np.arange(2**level + 1, dtype=np.int64) * count >> level


def _halved(centers: np.ndarray, depth: int) -> np.ndarray:
    """Return an order in which the parts of every level are halves of the part above, parted along its longest side."""
    order = np.arange(len(centers))
    for level in range(depth):
        borders = _borders(len(centers), level)
        part = np.repeat(np.arange(2**level), np.diff(borders))
        there = centers[order]
        extent = np.maximum.reduceat(there, borders[:-1]) - np.minimum.reduceat(there, borders[:-1])
        along = there[np.arange(len(order)), extent.argmax(axis=1)[part]]
        order = order[np.lexsort((along, part))]
    return order
