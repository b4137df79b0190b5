"""The meaning of a render, by brute force: every particle against every pixel, in float64.

Only the key by which a pixel's fragments are ordered is float32, computed as the renderer documents it
(camera-projected ends, clipped to the neighbourhood of the pixel's 8 x 16 tile if long): two orders that
differ in a rounding would differ much in colour. `exact_keys` gives the keys without any of that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .paths_reference import connect
from .polygon_reference import composite, fragments_of
from .seen import homogeneous, planes

F = np.float32
MOMENTS = {"linear": 0.15, "gaussian": 0.09780020026157243, "disc": 0.25}
"""Mean of x^2 over a still particle of radius 1."""
INTEGRALS = {  # (across a streak, over a still particle) of radius 1
    "linear": (1.0, math.pi / 3),
    "gaussian": (0.8201803507618952, 0.6628397001716525),
    "disc": (2.0, math.pi),
}


@dataclass
class Segment:
    """One streak on the screen."""

    head: np.ndarray
    way: np.ndarray
    radius: tuple[float, float]
    key: tuple[F, F]
    colors: np.ndarray
    opacity: tuple[float, float]
    falloff: str
    solid: bool
    add: bool
    perspective: bool
    confusion: tuple[float, float] = (0.0, 0.0)
    """Pixels out of focus at head and tail, times the square root of 1 / (4 moment)."""
    cut: tuple[float, float] = (0.0, 1.0)
    """The part between the near and the far plane."""
    time: float = 1.0
    """The part of the particle's time that it takes."""
    chain: tuple[float, float] | None = None
    """Length and time of the segments in a row that go on in each other, if it is one of those."""
    planes: tuple[np.ndarray | None, np.ndarray | None] = (None, None)
    """The normals of the planes in which it ends where it goes on in others."""
    light: float = 1.0
    straight: Segment | None = None
    """What makes that chain's light right, and the chain as it were if it went straight on."""

    @property
    def length(self) -> float:
        return float(np.hypot(*self.way))

    @property
    def unit(self) -> np.ndarray:
        return self.way / (self.length or 1.0)

    @property
    def pace(self) -> float:
        """Return the length it would have if all of it were as deep as 1."""
        return self.length / (self.inverse_depth(0) * self.inverse_depth(1))

    def speed(self, inverse_depth):
        """Return the speed on the screen at a depth, pixels a shutter."""
        return self.pace / self.time * inverse_depth**2

    @property
    def reach(self) -> float:
        return max(self.drawn(0.0), self.drawn(1.0)) + (0.5 if self.falloff == "disc" else 0.0)

    def nearest(self, x, y):
        """Return t of the closest point to pixel centres, and the distance."""
        across, down = x - self.head[0], y - self.head[1]
        squared = self.length**2
        t = np.clip((across * self.way[0] + down * self.way[1]) / squared, 0, 1) if squared > 1e-12 else across * 0
        return t, np.hypot(across - t * self.way[0], down - t * self.way[1])

    def drawn(self, t):
        """Return the radius that is drawn: as spread as what is convolved with the lens's disc, and at least a pixel."""
        radius = self.radius[0] + t * (self.radius[1] - self.radius[0])
        confusion = self.confusion[0] + t * (self.confusion[1] - self.confusion[0])
        return np.maximum(np.hypot(radius, confusion), 1.0)

    def owned(self, x, y):
        """Return the pixels that are not nearer to the line of a segment in which this one goes on."""
        owned = np.ones(x.shape, bool)
        for normal, corner in zip(self.planes, (self.head, self.head + self.way), strict=True):
            if normal is not None:
                beyond = (x - corner[0]) * normal[0] + (y - corner[1]) * normal[1]
                owned &= beyond >= 0 if corner is self.head else beyond < 0
        return owned

    def at(self, x, y):
        """Return (opacity before that of the particle, t, whether there is a fragment) at pixel centres."""
        t, distance = self.nearest(x, y)
        distance = np.where(self.owned(x, y), distance, np.inf)
        radius = self.radius[0] + t * (self.radius[1] - self.radius[0])
        clamped = self.drawn(t)
        across, area = INTEGRALS[self.falloff]
        if self.falloff == "disc":
            shape = np.clip(clamped + 0.5 - distance, 0, 1)
        elif self.falloff == "linear":
            shape = np.maximum(1 - distance / clamped, 0)
        else:
            edge = math.exp(-4.5)
            shape = np.maximum((np.exp(-4.5 * (distance / clamped) ** 2) - edge) / (1 - edge), 0)
        length, time = self.chain or (self.length, self.time)
        if self.solid:
            total, room = (area * r**2 + across * r * length for r in (radius, clamped))
            return shape * total / room, t, shape > 0
        speed = self.speed(self.inverse_depth(t)) * time if self.time > 0 else self.length
        return shape * area * radius**2 / (area * clamped**2 + across * clamped * speed), t, shape > 0

    def inverse_depth(self, t):
        """Return 1 / w at t; 1 where depth does not matter."""
        k0, k1 = (-np.float64(k) for k in self.key)
        return k0 + t * (k1 - k0) if self.perspective else 1.0

    def attributes(self, t):
        """Return (opacity, colours) at t."""
        s = t * self.inverse_depth(1) / self.inverse_depth(t)
        colors = self.colors[0][:, None, None] * (1 - s) + self.colors[1][:, None, None] * s
        return self.opacity[0] * (1 - s) + self.opacity[1] * s, colors


def value(column, i, components=0):
    """Return particle i's value of a column, or the one for all."""
    array = np.asarray(column, np.float32)
    return np.float64(array if array.ndim == bool(components) else array[..., i])


def evened(segment):
    """Return the factor that keeps a small particle's sum over all pixel centres at its true total."""
    if segment.chain is not None:
        return evened(segment.straight)
    fade = np.clip(2 - max(np.hypot(segment.radius, segment.confusion)), 0, 1) * np.clip(2 - segment.length / 64, 0, 1)
    if fade == 0:
        return 1.0
    across, area = INTEGRALS[segment.falloff]
    share = np.linspace(0, 1, 2001)
    radius, opacity = (first + share * (last - first) for first, last in (segment.radius, segment.opacity))
    true = area * np.trapezoid(radius**2 * opacity, share)
    if segment.solid:
        true = area * (radius**2 * opacity)[[0, -1]].mean() + across * segment.length * np.trapezoid(radius * opacity, share)
    low, high = (np.floor(edge(segment.head, segment.head + segment.way)) for edge in (np.minimum, np.maximum))
    x, y = np.meshgrid(*(np.arange(first - 5, last + 6) + 0.5 for first, last in zip(low, high, strict=True)))
    shape, t, _ = segment.at(x, y)
    sampled = (shape * segment.attributes(t)[0]).sum()
    return 1 + fade * (true / sampled - 1) if sampled > 0 else 1.0


def project(stream, i, head_camera, tail_camera, width, height):
    """Return particle i's Segment, None if it cannot be seen, or "dropped"."""
    tail = stream.head if stream.tail is None else stream.tail
    radii = [value(stream.head_radius if r is None else r, i) for r in (stream.head_radius, stream.tail_radius)]
    colors = [value(stream.head_color if c is None else c, i, 3) for c in (stream.head_color, stream.tail_color)]
    opacities = [value(stream.head_opacity if o is None else o, i) for o in (stream.head_opacity, stream.tail_opacity)]
    share, part = value(stream.share, i), np.clip(value(stream.part, i), 0, 1)
    if not np.isfinite([*stream.head[:, i], *tail[:, i], *radii, *np.ravel(colors), *opacities, share]).all():
        return "dropped"
    ends = []  # what is linear in s: see `homogeneous`
    for moment, point, radius, color, opacity in zip(
        (stream.head_moment, stream.tail_moment), (stream.head[:, i], tail[:, i]), radii, colors, opacities, strict=True
    ):
        early, late = (homogeneous(camera, point, radius, width, height) for camera in (head_camera, tail_camera))
        moment = value(moment, i)
        ends.append(np.array([*((1 - moment) * early + moment * late), *color, np.clip(opacity, 0, 1)]))
    cut = planes(ends[0][2], ends[1][2], head_camera.near, head_camera.far)
    if cut is None or max(ends[0][3], ends[1][3]) == 0:
        return None
    first, last = (ends[0] + s * (ends[1] - ends[0]) if 0 < s < 1 else ends[int(s)] for s in cut)
    divisors = (first[2], last[2]) if head_camera.perspective else (1.0, 1.0)
    points = [end[:2] / d for end, d in zip((first, last), divisors, strict=True)]
    keys = [F(-1 / end[2] if head_camera.perspective else end[2]) for end in (first, last)]
    spread = 0.5 / math.sqrt(MOMENTS[stream.falloff])
    return Segment(
        points[0], points[1] - points[0], (first[3] / divisors[0], last[3] / divisors[1]), tuple(keys),
        np.stack([first[5:8], last[5:8]]), (first[8], last[8]), stream.falloff, stream.streak == "solid", stream.blend == "add",
        head_camera.perspective, (spread * first[4] / divisors[0], spread * last[4] / divisors[1]), cut, part * (cut[1] - cut[0]),
    )


def segments_of(stream, head_camera, tail_camera, width, height):
    """Return the Segment of each particle of a stream, None if it cannot be seen, or "dropped"."""
    made = [project(stream, i, head_camera, tail_camera, width, height) for i in range(stream.head.shape[1])]
    connect(stream, made, INTEGRALS[stream.falloff])
    factors = [evened(segment) if isinstance(segment, Segment) else 0 for segment in made]
    for i, (segment, factor) in enumerate(zip(made, factors, strict=True)):
        if isinstance(segment, Segment):
            if not segment.solid:
                factor *= np.clip(value(stream.share, i), 0, 1) * segment.light
                factor *= segment.chain[1] if segment.chain else segment.time
            segment.opacity = tuple(opacity * factor for opacity in segment.opacity)
    return made


def keys_of(segment, left, top):
    """Return the float32 keys of the 8 x 16 pixels whose first pixel's centre is (left, top), as documented in layer.py."""
    x, y = segment.head[0] - left, segment.head[1] - top
    dx, dy = segment.way
    first, last = 0.0, 1.0
    if max(abs(dx), abs(dy)) > 64:
        margin = np.float64(max(F(segment.radius[0]), F(segment.radius[1]), F(1)))
        margin += 1.5 if segment.falloff == "disc" else 1.0
        for start, way, size in ((x, dx, 7), (y, dy, 15)):
            if way != 0:
                a, b = (-margin - start) / way, (size + margin - start) / way
                first, last = max(first, min(a, b)), min(last, max(a, b))
        if margin > 64 and first < last:
            nearest = [-((x - i) * dx + (y - j) * dy) / segment.length**2 for i in (0, 7) for j in (0, 15)]
            first, last = np.clip([min(nearest) - 1 / segment.length, max(nearest) + 1 / segment.length], first, last)
    share = last - first
    k0, k1 = np.float64(segment.key[0]), np.float64(segment.key[1])
    local_x, local_y, way_x, way_y = F(x + first * dx), F(y + first * dy), F(dx * share), F(dy * share)
    key, key_way = F(k0 + first * (k1 - k0)), F(share * (k1 - k0))
    squared = way_x * way_x + way_y * way_y
    inverse = F(1) / squared if squared > F(1e-12) else F(0)
    across = np.arange(8, dtype=F)[None, :] - local_x
    down = np.arange(16, dtype=F)[:, None] - local_y
    t = np.minimum(np.maximum((across * way_x + down * way_y) * inverse, F(0)), F(1))
    return np.clip(key + t * key_way, min(segment.key), max(segment.key))


def exact_keys(segment, left, top):
    """Return the same in float64, without clipping."""
    x, y = np.meshgrid(left + np.arange(8.0), top + np.arange(16.0))
    k0, k1 = np.float64(segment.key[0]), np.float64(segment.key[1])
    return k0 + segment.nearest(x, y)[0] * (k1 - k0)


def reference(streams, head_camera, tail_camera, width, height, polygons=(), lighting=None):
    """Return (pixels float64 (height, width, 4), number of fragments, number of dropped particles and triangles)."""
    tail_camera = tail_camera or head_camera
    made = [each for stream in streams for each in segments_of(stream, head_camera, tail_camera, width, height)]
    dropped = sum(isinstance(m, str) for m in made)
    between, lost = fragments_of(polygons, lighting, head_camera, width, height)
    segments = [m for m in made if isinstance(m, Segment) and m.opacity != (0, 0)]
    segments.sort(key=lambda segment: min(segment.key) + F(0))
    pixels = np.zeros((-(-height // 16) * 16, -(-width // 8) * 8, 4))
    fragments = 0
    for top in range(0, height, 16):
        for left in range(0, width, 8):
            tile = pixels[top : top + 16, left : left + 8]
            there = [row[left : left + 8] for row in between[top : top + 16]]
            fragments += _tile(segments, tile, left + 0.5, top + 0.5, min(width - left, 8), min(height - top, 16), there)
    return pixels[:height, :width], fragments, dropped + lost


def _tile(segments, tile, left, top, columns, rows, between):
    x, y = np.meshgrid(left + np.arange(8.0), top + np.arange(16.0))
    layers = []
    for segment in segments:
        low, high = np.minimum(0, segment.way) + segment.head, np.maximum(0, segment.way) + segment.head
        reach = segment.reach + 1
        if high[0] < left - reach or low[0] > left + 7 + reach or high[1] < top - reach or low[1] > top + 15 + reach:
            continue
        opacity, t, hit = segment.at(x, y)
        if hit.any():
            own, colors = segment.attributes(t)
            keys = np.where(hit, keys_of(segment, left, top), F(np.inf))
            layers.append((keys, np.minimum(opacity * own, 1), colors, hit, segment.add))
    if not layers:
        _put_between(between, tile, np.zeros((0, 16, 8)), np.zeros((0, 16, 8)), np.zeros((0, 3, 16, 8)), np.zeros((0, 16, 8)))
        return 0
    keys, opacities, colors, hits, adds = (np.stack(part) for part in zip(*layers, strict=True))
    order = np.argsort(keys, axis=0, kind="stable")
    opacities = np.take_along_axis(np.where(hits, opacities, 0), order, 0)
    colors = np.take_along_axis(colors, order[:, None], 0)
    through = np.cumprod(1 - np.where(adds[order], 0, opacities), axis=0)
    before = np.concatenate([np.ones((1, 16, 8)), through[:-1]])
    tile[..., :3] = np.moveaxis((before[:, None] * opacities[:, None] * colors).sum(0), 0, -1)
    tile[..., 3] = 1 - through[-1]
    _put_between(between, tile, np.take_along_axis(keys, order, 0), opacities, colors, adds[order])
    return int(hits[:, :rows, :columns].sum())


def _put_between(between, tile, keys, opacities, colors, adds):
    """Composite the pixels that have polygons anew, with the particles' fragments in order along the first axis."""
    for row, fragments in enumerate(between):
        for column, there in enumerate(fragments):
            if there:
                at = (slice(None), row, column)
                hit = keys[at] < np.inf
                tile[row, column] = composite(
                    there, keys[at][hit], opacities[at][hit], colors[:, :, row, column][hit], adds[at][hit]
                )
