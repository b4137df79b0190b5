"""When an emitter's particles are born, and when they die."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from graphfx.cook.moments import NO_FLOW, Flow, Moments, moments
from graphfx.errors import LimitError, Problem
from graphfx.graph.values import Literal
from graphfx.motion.clock import Interval
from graphfx.plan.make import EmitterPlan
from graphfx.plan.pictures import plain_value

MOST = 1 << 30
"""Births of one emitter between two frames."""


@dataclass
class Births:
    """The births of one emitter: those of its rate, and those made at once as it begins and again after `every` seconds.

    `vertices` are made besides as it begins. `made` is the integral of the rate so far; the k-th particle is born as it passes k.

    For a constant rate that instant is begin + k / rate whatever the frames are, so the 0th is born as the emitter
    begins. A rate that changes is taken at the middle of each interval; `following` is the number of the next birth.
    """

    plan: EmitterPlan
    start: float
    vertices: int = 0
    made: float = 0.0
    following: int = 0

    def __post_init__(self) -> None:
        """Note when the emitter begins and ends."""
        during = self.plan.node.during or (-math.inf, math.inf)
        self.begin, self.finish = max(self.start, during[0]), during[1]
        node = self.plan.node
        rated = "rate" in node.given or not ("count" in node.given or "vertices" in node.references)
        self.rate = node.arguments["rate"] if rated else Literal("float", value=0.0)

    def at_start(self) -> Moments:
        """Return the times of the particles born at the very beginning: a burst, and the first of a rate."""
        rate = float(plain_value(self.rate, self.start))
        here = self.begin == self.start and self.finish > self.start
        self.following = 1 if rate > 0 and here else 0
        return moments([self.start], [self.following + (self._count(self.start) if here else 0)])

    def within(self, interval: Interval) -> Moments:
        """Return the times of birth in (start, end], in order [s]."""
        times = self._bursts(interval)
        counts = [self._count(time, interval.frame) for time in times]
        low, high = max(interval.start, self.begin), min(interval.end, self.finish)
        if high < low:
            return moments(times, counts)
        if isinstance(self.rate, Literal):
            return moments(times, counts, *self._steady(float(self.rate.value), interval, high))
        return moments(times, counts, *self._varying(float(plain_value(self.rate, (low + high) / 2, interval.frame)), low, high))

    def _count(self, time: float, frame: int = 0) -> int:
        """Return how many are made at once; what is no number counts as none."""
        more = self.vertices if time == self.begin else 0
        count = float(plain_value(self.plan.node.arguments["count"], time, frame))
        if not count > 0:
            return more
        self._until(0, count, "count")
        return more + int(count)

    def _bursts(self, interval: Interval) -> list[float]:
        """Return when in (start, end] some are made at once: at begin + n every."""
        every = float(plain_value(self.plan.node.arguments["every"]))
        first, last = interval.start - self.begin, min(interval.end, self.finish) - self.begin
        if last < 0 or (first >= 0 and not every < math.inf):
            return []
        begin = 0 if first < 0 else math.floor(first / every)
        end = math.floor(last / every) + 1 if every < math.inf else 0
        self._until(begin, end, "every")
        times = [self.begin + (n * every if n else 0.0) for n in range(begin, end + 1)]
        return [time for time in times if interval.start < time <= min(interval.end, self.finish)]

    def _varying(self, rate: float, low: float, high: float) -> tuple[Flow, int, int]:
        """Return the times of numbered births, the first number from `low` on, and how many there are."""
        if not rate > 0:
            return NO_FLOW
        before, self.made = self.made, self.made + rate * (high - low)
        first = self.following
        self.following += self._until(first, self.made)
        return lambda numbers: np.clip(low + (numbers - before) / rate, low, high), first, self.following - first

    def _steady(self, rate: float, interval: Interval, high: float) -> tuple[Flow, int, int]:
        """Return the times of numbered births, the first number of an interval, and how many there are."""
        if not rate > 0:
            return NO_FLOW
        already = math.floor((interval.start - self.begin) * rate) + 1 if interval.start >= self.begin else 0
        count = self._until(already, (high - self.begin) * rate)
        return lambda numbers: np.clip(self.begin + numbers / rate, interval.start, interval.end), already, count

    def _until(self, first: int, made: float, name: str = "rate") -> int:
        """Return how many births there are from number `first` until the integral of the rate is `made`."""
        if not made - first < MOST:
            remedy = "make every longer" if name == "every" else f"lower the {name}"
            message = f"{made - first:,.0f} particles would be born in one frame, and the limit is {MOST:,}; {remedy}"
            raise LimitError(Problem(message, self.plan.node.location, f"nodes.{self.plan.path}.{name}"))
        return max(math.floor(made) + 1 - first, 0)
