"""Make a plan: what will really run, and why the rest will not."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.names import OUTPUTS, PICTURES
from graphfx.graph.values import Literal, Value
from graphfx.motion.clock import most_cuts
from graphfx.node import INFINITY
from graphfx.plan.birth import BirthWriter
from graphfx.plan.ends import EndWriter
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.holder import Holder, draws_in, find_holders, names_in
from graphfx.plan.liveness import MEASURED, Attributes, Reading, find_attributes, reads_at_birth, reads_of_spawn
from graphfx.plan.matrix_form import gathered
from graphfx.plan.method import Choice, cells_met, choose_method
from graphfx.plan.moment import Constants
from graphfx.plan.motion import Motion, Mover, mover_of
from graphfx.plan.pacing import SHARE
from graphfx.plan.pictures import Drawn, ImagePlan, MoviePlan, image_plan
from graphfx.plan.rounding import REMAINDER
from graphfx.plan.schedule import Schedule, make_schedule, never_acts
from graphfx.plan.shutter import Exposure, exposure_of
from graphfx.plan.sources import Sources
from graphfx.plan.spawning import SpawnPlan, SpawnWriter
from graphfx.plan.steps import FrameWriter
from graphfx.plan.support import MOVING_ROLES, check_names, check_support
from graphfx.program import Program


@dataclass
class EmitterPlan:
    """One source of particles: their columns, their operators, their programs.

    `births` are the programs of all who make particles of it, its own first. `main` and `own` are None where nothing
    happens in a step, `main` also where all particles have steps of their own; `closing` is what is set as a frame ends,
    `closing_at` as a life ends within it. `places` are where that puts particles at instants before, by column: the old
    ones, and those born after it. `at_death` is what is set then and who begins another life; `seeds` finds positions
    alone, for clusters. `method` is how motion is computed, `reason` why.
    `constants` are the attributes that are one for all. `exposure` is what pictures see of the past.
    """

    holder: Holder
    attributes: Attributes
    motion: Motion
    method: str
    reason: str
    constants: dict[str, Any]
    births: dict[str, FrameProgram]
    exposure: Exposure
    main: FrameProgram | None
    own: FrameProgram | None
    closing: FrameProgram | None
    closing_at: FrameProgram | None
    places: dict[str, tuple[FrameProgram, FrameProgram]]
    at_death: FrameProgram | None
    seeds: FrameProgram | None
    spawns: list[SpawnPlan]

    @property
    def node(self) -> FlatNode:
        """Return the node that makes the particles."""
        return self.holder.maker

    @property
    def path(self) -> str:
        """Return the path of the node that makes the particles."""
        return self.holder.path

    @property
    def operators(self) -> list[FlatNode]:
        """Return the operators that act on the particles, in order."""
        return self.holder.operators

    @property
    def made_programs(self) -> list[FrameProgram]:
        """Return all programs, births first."""
        spawning = [made for spawn in self.spawns for made in (spawn.rate, spawn.offspring)]
        placing = [made for both in self.places.values() for made in both]
        others = (self.seeds, self.main, self.own, *placing, self.closing, self.closing_at, self.at_death, *spawning)
        return [made for made in (*self.births.values(), *others) if made is not None]

    @property
    def programs(self) -> list[Program]:
        """Return all programs, births first."""
        return [made.program for made in self.made_programs]

    @property
    def mortal(self) -> bool:
        """Return whether particles die of age."""
        return bool(self.constants.get("life", 0.0) < INFINITY)


@dataclass
class Plan:
    """A whole graph, ready to cook; `emitters` are all sources of particles, parents first."""

    flat: FlatGraph
    schedule: Schedule
    emitters: dict[str, EmitterPlan]
    images: list[ImagePlan]
    movies: list[MoviePlan] = field(default_factory=list)

    @property
    def stills(self) -> list[ImagePlan]:
        """Return the images whose pictures are files: those that no movie takes, and those that name their files."""
        taken = [movie.image for movie in self.movies]
        return [image for image in self.images if image not in taken or "file" in image.node.given]

    @property
    def precision(self) -> int:
        """Return 32 or 64: the bits of a real."""
        return self.flat.time.precision


def make_plan(
    flat: FlatGraph, *, prune: bool = True, measured: tuple[str, ...] = (), choices: Mapping[str, Choice] | None = None
) -> Plan:
    """Plan a flattened graph.

    `prune=False` keeps what could be left out, to show that it changes no byte: nodes that no output needs, attributes
    that nothing reads, operators that act outside the simulated time. Those that do nothing are left out either way.
    `measured` attributes are stored of all sources, where they differ, and nothing is kept for pictures, of which none is
    drawn. `choices` are what the method `auto` comes to, by source; where there is none, it is one symmetric step for each of
    the graph's.
    """
    schedule = make_schedule(flat, flat.time.precision, prune=prune)
    check_support(flat, schedule.order)
    sources = Sources(flat, schedule)
    outputs = [flat.nodes[path] for path in schedule.order if flat.nodes[path].node_type.role in OUTPUTS]
    images = {node.path: image_plan(node, sources) for node in outputs if node.node_type.role in PICTURES}
    movies = [MoviePlan(node, images[node.references["image"]]) for node in outputs if node.node_type.role == "movie"]
    holders = find_holders(sources)
    check_names(holders, flat)
    drawn = [] if measured else list(images.values())
    planner = _Planner(flat, drawn, holders, prune, measured, choices or {})
    emitters = {path: planner.emitter(path) for path in reversed(holders)}
    return Plan(flat, schedule, {path: emitters[path] for path in holders}, drawn, [] if measured else movies)


class _Planner:
    """Plans sources, children before their parents, since those must store what children read."""

    def __init__(
        self,
        flat: FlatGraph,
        images: list[ImagePlan],
        holders: dict[str, Holder],
        prune: bool,
        measured: tuple[str, ...],
        choices: Mapping[str, Choice],
    ):
        self.choices = choices
        self.flat, self.images, self.holders, self.prune, self.measured = flat, images, holders, prune, measured
        self.stored: dict[str, list[str]] = {}
        """What is stored of each source, as far as it is known."""
        self.attributes = self._all_attributes()

    def _drawn(self, path: str) -> tuple[list[Drawn], Exposure]:
        """Return the streams of images that draw a source's particles, and what is kept for their shutters."""
        drawn = [(image, each) for image in self.images for each in image.streams if each.path == path]
        windows = [window for image, _ in drawn for window in image.windows(self.flat.time)]
        return [each for _, each in drawn], exposure_of(windows)

    def _all_attributes(self) -> dict[str, Attributes]:
        """Find what is stored of each source: all that its children read, which grows until no child needs more."""
        while True:
            known = dict(self.stored)
            found = {}
            for path in reversed(self.holders):
                found[path] = self._attributes(self.holders[path], *self._drawn(path))
            if self.stored == known:
                return found

    def emitter(self, path: str) -> EmitterPlan:
        """Return the plan of one source."""
        flat, holder = self.flat, self.holders[path]
        seed, precision, substeps = flat.seed, flat.time.precision, flat.time.substeps
        drawn, exposure = self._drawn(path)
        attributes = self.attributes[path]
        if not all(instant.column in attributes.columns for instant in exposure.instants):
            exposure = replace(exposure, instants=())
        motion, choice = self._motion(holder, attributes)
        constants = Constants(holder, attributes, seed, precision)
        writer = FrameWriter(holder, attributes, motion, constants.find, seed, precision, substeps)
        moves = bool(motion.movers) or motion.has_velocity
        ends = EndWriter(writer)
        put = exposure.within if ends.moves else []
        births = BirthWriter(holder, attributes, seed, precision)
        nearest = any(each.by == "nearest" and self._counted(holder, attributes, name) for name, each in holder.clusters.items())
        spawning = SpawnWriter(path, attributes, constants.find, seed, precision)
        for each in drawn:
            if each.condition is not None:
                each.selection = ends.selection(each.condition)
        return EmitterPlan(
            holder,
            attributes,
            motion,
            choice.method,
            choice.reason,
            {name: constants.find(name).value for name in attributes.constants},
            {maker.path: births.write(maker) for maker in (holder.maker, *holder.adders)},
            exposure,
            writer.main(exposure.within if moves else []) if (moves or writer.acts) and not choice.scheme.paced else None,
            writer.own(exposure.within if moves else []) if moves or writer.acts else None,
            ends.closing(),
            ends.closing(own=True) if put else None,
            {instant.column: (ends.place(instant), ends.place(instant, own=True)) for instant in put},
            ends.at_death(),
            births.write(holder.maker, ["position"]) if nearest else None,
            [spawning.plan(node, self._home(node), [each.path for each in holder.of_role("surface")]) for node in holder.spawns],
        )

    def _motion(self, holder: Holder, attributes: Attributes) -> tuple[Motion, Choice]:
        """Return how a source's particles move, and have stored what that needs."""
        time = self.flat.time
        movers = [mover_of(node, bool(never_acts(node, self.flat)), holder.changing) for node in holder.of_role(*MOVING_ROLES)]
        has_velocity = "velocity" in attributes.columns or _nonzero(attributes.constants.get("velocity"))
        movers = gathered(movers, attributes.constants, time.method, has_velocity)
        choice = choose_method(movers, self.flat, has_velocity, self.choices.get(holder.path))
        cells = cells_met(movers, time, choice.method)
        motion = Motion(movers, choice.method, has_velocity, cells, holder.changing, choice.scheme)
        motion.cuts = cut_times(holder, movers) if choice.method != "sims" else frozenset()
        motion.most_cuts = most_cuts(motion.cuts, time.fps)
        if choice.scheme.paced:
            attributes.store(SHARE, "float", "how long its steps are", "float")
        motion.keeps = time.precision == 64 and motion.may_keep and "position" in attributes.columns and not holder.places_again
        if motion.keeps:
            attributes.store(REMAINDER, "vec3", "what rounding took from the position", "vec3")
        return motion, choice

    @staticmethod
    def _counted(holder: Holder, attributes: Attributes, cluster: str) -> bool:
        """Return whether the numbers of a cluster are wanted."""
        return cluster in attributes.columns or reads_at_birth(holder, attributes, cluster)

    @staticmethod
    def _home(spawn: FlatNode) -> str:
        return spawn.references.get("into", spawn.path)

    def _attributes(self, holder: Holder, drawn: list[Drawn], exposure: Exposure) -> Attributes:
        """Find what is stored, and what that asks of the parents."""
        reading = Reading(holder)
        reading.note(self.measured, MEASURED)
        for image in self.images:
            if any(each.path == holder.path for each in image.streams):
                reading.note(image.reads, "the renderer")
        for each in drawn:
            if each.condition is not None:
                reading.note(names_in(each.condition) | ({"id"} if draws_in(each.condition) else set()), "what is drawn")
        for spawn in holder.spawns:
            home = self.holders[self._home(spawn)]
            maker = next(each for each in (home.maker, *home.adders) if each.path == spawn.path)
            stored = self.stored.get(home.path, [])
            reading.note(reads_of_spawn(home, maker, home.parents_of(maker), stored), spawn.path)
        reading.operators()
        found = find_attributes(reading, exposure, self.prune)
        self.stored[holder.path] = [name for name in found.types if name in holder.table or name in holder.clusters]
        return found


def cut_times(holder: Holder, movers: list[Mover]) -> frozenset[float]:
    """Return when operators that move or fade begin to act, or end [s]."""
    nodes = [*(mover.node for mover in movers if not mover.idle), *holder.of_role("fade")]
    return frozenset(float(time) for node in nodes for time in node.during or () if math.isfinite(time))


def _nonzero(value: Value | None) -> bool:
    return value is not None and not (isinstance(value, Literal) and not any(value.value))
