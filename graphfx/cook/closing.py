"""What is done as a frame ends: what is set then, and who is killed."""

from __future__ import annotations

import numpy as np

from graphfx.cook.beginnings import Endings
from graphfx.cook.lives import Lives
from graphfx.cook.moments import pieces
from graphfx.cook.particles import Particles, padded
from graphfx.motion.clock import Interval
from graphfx.plan.frame_program import FrameProgram


def close(lives: Lives, particles: Particles, interval: Interval, first: int = 0) -> None:
    """Do what is set as a frame ends, on rows from `first` on, and end the lives of those who are killed then."""
    made = particles.plan.closing
    assert made is not None
    kills, placed = "fate" in made.program.stores, particles.plan.closing_at
    if first == 0 and not kills and (placed is None or not len(particles.dying)):
        lives.programs.run(made, particles, interval)
        return
    before = Endings([particles.endings.all()])
    for start, stop in pieces(first, particles.store.count):
        rows = np.arange(start, stop)
        _close_some(lives, made, particles, interval, rows, before.of(rows))


def _close_some(
    lives: Lives, made: FrameProgram, particles: Particles, interval: Interval, rows: np.ndarray, ended: np.ndarray
) -> None:
    """Close the frame for some rows, of which some ended at a time [s]; the others did at infinity."""
    kills, placed = "fate" in made.program.stores, particles.plan.closing_at
    dying = np.isfinite(ended)
    listed = rows if placed is None else rows[~dying]
    fate = padded(np.zeros(len(listed)), lives.programs.real)
    lives.programs.run(made, particles, interval, listed, by_place={"fate": (fate,)} if kills else None)
    if placed is not None and dying.any():
        begin = padded(ended[dying] - interval.start, lives.programs.real)
        lives.programs.run(placed, particles, interval, rows[dying], by_place={"begin": (begin,)})
    if kills:
        killed = listed[(fate[: len(listed)] > 0) & ~dying[listed - rows[0]]]
        when = np.full(len(killed), interval.length)
        lives.die(particles, interval, killed, when)
        particles.endings.note(killed, interval.start + when)
