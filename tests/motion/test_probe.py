"""The probe finds what form a linear operator has, and refuses what is not of it."""

from __future__ import annotations

from typing import Any

import pytest

from graphfx.math import Vec3, cross, length, unit
from graphfx.motion.probe import LinearForm, probe

from .one_particle import LIBRARY


def form_of(name: str) -> LinearForm | None:
    """Return the form of a node of the library."""
    node = LIBRARY[name]
    return probe(
        node.function,
        node.arguments,
        tuple("vec3" if node.argument_type(name) in ("vec3", "direction", "point") else "float" for name in node.arguments),
    )


@pytest.mark.parametrize(
    "name, form",
    [
        ("gravity", (True, False, False, False)),
        ("spiral", (False, False, True, False)),
        ("wind", (True, True, False, False)),
        ("spring", (True, True, False, True)),
    ],
)
def test_shipped_operators(name, form):
    """Gravity is a constant, spiral a turning, wind a damping and a constant, a spring all but a turning."""
    assert form_of(name) == LinearForm(*form)


def all_three(velocity: Any, wind: Any, k: Any) -> Any:
    return (wind - velocity) * k + cross(wind, velocity)


def spring(position: Any, k: Any) -> Any:
    return position * -k


def pulled_aside(position: Any, k: Any) -> Any:
    return Vec3(position.x * -k, position.y * (k * -2.0), position.z * 0.0)


def quadratic(velocity: Any, k: Any) -> Any:
    return velocity * length(velocity) * -k


def normalised(velocity: Any) -> Any:
    return unit(velocity)


def uneven(velocity: Any, k: Any) -> Any:
    return Vec3(velocity.x * -k, velocity.y * (k * -2.0), velocity.z * 0.0)


def sheared(velocity: Any) -> Any:
    return Vec3(velocity.y, velocity.y * 0.0, velocity.z * 0.0)


def field(position: Any, velocity: Any) -> Any:
    return velocity * -1.0 + position * 1e-6


def test_pulls_to_a_place():
    """What pulls to the origin alone is a stiffness alone; a weak one is not overlooked, nor one that drives away."""
    assert probe(spring, ("position", "k"), ("vec3", "float")) == LinearForm(False, False, False, True)
    assert probe(field, ("position", "velocity"), ("vec3", "vec3")) == LinearForm(False, True, False, True)


def test_sum_of_all():
    """Wind that drags and turns has all three terms."""
    assert probe(all_three, ("velocity", "wind", "k"), ("vec3", "vec3", "float")) == LinearForm(True, True, True)


@pytest.mark.parametrize("wrong", [pulled_aside, quadratic, normalised, uneven, sheared], ids=lambda wrong: wrong.__name__)
def test_other_forms_are_refused(wrong):
    """What is not linear, or damps or pulls unevenly, has no such form."""
    names = wrong.__code__.co_varnames[: wrong.__code__.co_argcount]
    assert probe(wrong, names, tuple("float" if name == "k" else "vec3" for name in names)) is None
