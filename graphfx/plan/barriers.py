"""Write contacts with sheets and meshes, which the way of a step meets: see `graphfx.motion.barrier`."""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.motion import barrier, basic, contact
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion, Mover
from graphfx.program import Builder, Column, Operand

TRIES = 40
"""How often a particle that slides is put back before the next face that it has passed."""


def is_barrier(surface: Mover) -> bool:
    """Return whether a surface is met by the way of a step, and has no signed distance."""
    return "end" in surface.node.node_type.reserved


@dataclass
class Plane:
    """The plane at which particles meet a surface: who does, a point of it, the normal to the side of the start."""

    surface: Mover
    hit: Column
    point: Column
    normal: Column

    def distance(self, builder: Builder, position: Operand) -> tuple[Column, Column]:
        """Return the signed distance of a position, and the normal."""
        return builder.call(barrier.plane_distance, position, self.point, self.normal, name="distance"), self.normal

    def take(self, builder: Builder, other: Plane) -> None:
        """Have another plane in its place, for the particles under the builder's mask."""
        builder.call(basic.copy_vector, other.point, into=self.point)
        builder.call(basic.copy_vector, other.normal, into=self.normal)


class Barriers:
    """The sheets and meshes among the surfaces of one source's stack."""

    def __init__(self, motion: Motion):
        self.motion = motion
        self.surfaces = [surface for surface in motion.of("surface") if is_barrier(surface)]

    def meet(self, surface: Mover, moment: Moment, state: State, builder: Builder, way: tuple[Operand, Operand]) -> Plane:
        """Write which particles under the builder's mask meet a surface on their way, and the plane there."""
        builder.note = surface.node.path
        operands = self.motion.arguments(surface, moment, state, {"start": way[0], "end": way[1]})
        hit, point, normal = builder.call(surface.function, *operands, name="met point normal")
        return Plane(surface, hit, point, normal)

    def slide(self, moment: Moment, state: State, begin: Column, tolerance: Column) -> None:
        """Write how a particle is kept before all of them where it has gone along; who finds no place stays at `begin`."""
        builder, velocity = moment.builder, state.velocity
        masks = [self.motion.under_conditions(surface, moment).mask for surface in self.surfaces]
        pressed = builder.call(basic.both, builder.mask, builder.mask, name="pressed")
        inner = builder.loop(pressed, TRIES, "back before the surface")
        again = inner.call(basic.but_not, pressed, pressed, name="again")
        for surface, mask in zip(self.surfaces, masks, strict=True):
            concerned = inner.under(inner.call(basic.both, inner.mask, mask))
            plane = self.meet(surface, moment, state, concerned, (begin, state.position))
            back = inner.under(plane.hit)
            above = back.call(barrier.from_above, plane.distance(back, state.position)[0], tolerance)
            into = (state.position, velocity)
            back.call(contact.slide_on_face, *into, above, plane.normal, into=into)  # type: ignore[arg-type]
            inner.call(basic.either, again, plane.hit, into=again)
        inner.call(basic.both, again, again, into=pressed)
        left = builder.under(pressed)
        left.call(basic.copy_vector, begin, into=state.position)  # type: ignore[arg-type]
        left.call(barrier.turned_back, velocity, into=velocity)  # type: ignore[arg-type]
