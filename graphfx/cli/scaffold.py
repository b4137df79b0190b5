"""Files for a new node: a function of its kind and role that works, and a test that passes."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass

from graphfx.node.roles import treatment


@dataclass(frozen=True)
class Pattern:
    """A function of one role: its docs' formula, what it imports, its decorator, arguments and body, and a case by hand."""

    formula: str
    math: str
    decorator: str
    arguments: tuple[str, ...]
    result: str
    returns: str
    body: tuple[str, ...]
    given: str
    expected: str
    case: str
    geometry: str = ""


PATTERNS = {
    "flow": Pattern(
        "P' = P + wind dt", "Vec3", '@operator.flow(writes="position", neutral="length(wind) == 0")',
        ("position: Vec3", "dt: float", 'wind: Vec3 = param((1, 0, 0), unit="m/s", doc="Velocity of the wind.")'),
        "Vec3", "the position after dt seconds", ("return position + wind * dt",),
        "position=Vec3(1.0, 0.0, 0.0), dt=0.5, wind=Vec3(2.0, 0.0, 0.0)", "(2.0, 0.0, 0.0)", "In half a second, 2 m/s are 1 m."),
    "linear": Pattern(
        "dV/dt = -drag V", "Vec3", '@operator.linear(writes="velocity", neutral="drag == 0")',
        ("velocity: Vec3", 'drag: float = param(1.0, unit="1/s", min=0, doc="Share of the speed lost per second, at first.")'),
        "Vec3", "the rate of change of the velocity", ("return velocity * -drag",),
        "velocity=Vec3(3.0, 0.0, 0.0), drag=2.0", "(-6.0, 0.0, 0.0)", "At 3 m/s a drag of 2 1/s takes 6 m/s^2."),
    "acceleration": Pattern(
        "A = -strength P / (1 + |P|^2)", "Vec3, dot", '@operator.acceleration(neutral="strength == 0")',
        ("position: Vec3", 'strength: float = param(1.0, unit="m^2/s^2", doc="Strength of the pull to the origin.")'),
        "Vec3", "the acceleration", ("return position * (-strength / (1.0 + dot(position, position)))",),
        "position=Vec3(1.0, 0.0, 0.0), strength=4.0", "(-2.0, 0.0, 0.0)", "At 1 m the pull is half its strength."),
    "velocity": Pattern(
        "dP/dt = strength (P_z, 0, -P_x) / (1 + |P|^2)", "Vec3, dot", '@operator.velocity(neutral="strength == 0")',
        ("position: Vec3", 'strength: float = param(1.0, unit="m^2/s", doc="Strength of the swirl about the y axis.")'),
        "Vec3", "the applied velocity",
        ("return Vec3(position.z, 0.0, -position.x) * (strength / (1.0 + dot(position, position)))",),
        "position=Vec3(0.0, 0.0, 1.0), strength=4.0", "(2.0, 0.0, -0.0)", "At 1 m on the z axis all move along x."),
    "assign": Pattern(
        "radius' = radius * share", "", '@operator.assign(writes="radius", neutral="share == 1")',
        ("radius: float", 'share: float = param(0.9, min=0, max=1, doc="Share of the radius that is left.")'),
        "float", "the new radius", ("return radius * share",),
        "radius=0.5, share=0.5", "0.25", "Half of 0.5 m is 0.25 m."),
    "surface": Pattern(
        "distance = P_y - height", "Vec3", "@operator.surface",
        ("position: Vec3", 'height: float = param(0.0, unit="m", doc="Height of the ground.")'),
        "tuple[float, Vec3]", "the signed distance from the ground and its normal",
        ("return position.y - height, Vec3(0.0, 1.0, 0.0)",),
        "position=Vec3(0.0, 3.0, 0.0), height=1.0", "(2.0, (0.0, 1.0, 0.0))",
        "At a height of 3 m the ground at 1 m is 2 m below."),
    "noise": Pattern(
        "A = strength (n_x, 0, n_z)", "Vec3", '@operator.noise(writes="velocity", neutral="strength == 0")',
        ("noise: Vec3", 'strength: float = param(1.0, unit="m/s^2", min=0, doc="Largest acceleration along the ground.")'),
        "Vec3", "the acceleration, proportional to a random vector n", ("return Vec3(noise.x, 0.0, noise.z) * strength",),
        "noise=Vec3(0.5, 0.25, -0.5), strength=2.0", "(1.0, 0.0, -1.0)", "What is random pushes along the ground alone."),
    "value": Pattern(
        "x = low + (high - low) (u + v) / 2", "", "@value",
        ("draw: tuple", 'low: float = param(0.0, doc="Least number.")', 'high: float = param(1.0, doc="Greatest number.")'),
        "float", "one number", ("return low + (high - low) * (draw[0] + draw[1]) * 0.5",),
        "draw=(0.25, 0.75, 0.0, 0.0), low=2.0, high=4.0", "3.0", "In the middle of what is drawn is the middle."),
    "selector": Pattern(
        "|P - center| < distance", "Vec3, length", "@selector",
        ("position: Vec3", 'center: Vec3 = param((0, 0, 0), unit="m", doc="The point.")',
         'distance: float = param(1.0, unit="m", min=0, doc="How far particles may be.")'),
        "bool", "whether the particle is near", ("return length(position - center) < distance",),
        "position=Vec3(0.0, 2.0, 0.0), center=Vec3(0.0, 0.0, 0.0), distance=3.0", "True", "At 2 m a particle is within 3 m."),
    "geometry": Pattern(
        "a square of `size`, in the plane of x and z", "", "@geometry",
        ('size: float = param(1.0, unit="m", min=0, doc="Length of its sides.")',),
        "Mesh", "the square", ("return grid(size, size, 1, 1)",), "size=2.0", "2", "A square is two triangles.", "Mesh, grid"),
}
"""By role. Each keeps the contract as it stands, so that a change that breaks it shows."""
DEFAULT_ROLES = {"operators": "flow", "values": "value", "selectors": "selector", "geometry": "geometry"}


def roles_of(kind: str) -> list[str]:
    """Return the roles that a new node of a kind may have, the usual one first."""
    usual = DEFAULT_ROLES.get(kind)
    if kind != "operators":
        return [usual] if usual else []
    return [role for role in PATTERNS if role not in DEFAULT_ROLES.values() or role == usual]


def node_text(name: str, kind: str, role: str) -> str:
    """Return the file of a new node."""
    pattern = PATTERNS[role]
    word = kind.removesuffix("s")
    imports = [*([f"from graphfx.geometry import {pattern.geometry}"] if pattern.geometry else []),
               *([f"from graphfx.math import {pattern.math}"] if pattern.math else []),
               f"from graphfx.node import {', '.join(sorted(('param', word)))}"]
    arguments = "".join(f"    {argument},\n" for argument in pattern.arguments)
    body = "".join(f"    {line}\n" for line in pattern.body)
    source = textwrap.fill(f"Say where the formula comes from. The engine {treatment(role)}.", 110)
    return (f'"""{title(name)}: say here in one sentence what it does.\n\n    {pattern.formula}\n\n{source}\n"""\n\n'
            + "\n".join(imports) + f"\n\n\n{pattern.decorator}\ndef {name}(\n{arguments}) -> {pattern.result}:\n"
            f'    """Return {pattern.returns}."""\n{body}')


def test_text(name: str, role: str) -> str:
    """Return the test of a new node."""
    pattern = PATTERNS[role]
    vectors = "Vec3" in pattern.given
    named = "distance, normal" if role == "surface" else "result"
    found = {"surface": "(distance, tuple(normal))", "geometry": "len(result.triangles)"}.get(role, "result")
    found = "tuple(result)" if pattern.result == "Vec3" else found
    return f'''"""The node `{name}`: it keeps the contract of every node, and gives what was worked out by hand."""

from pathlib import Path

import pytest

from graphfx.contract import subject, truths_of
{"from graphfx.math import Vec3" + chr(10) if vectors else ""}
SUBJECT = subject("{name}", library=Path(__file__).parents[1])


@pytest.mark.parametrize("truth", truths_of(SUBJECT), ids=lambda truth: truth.__name__)
def test_contract(truth):
    """It is documented, finite, the same on the machine as in plain Python, true to its role, and its sample cooks."""
    truth(SUBJECT)


def test_by_hand():
    """{pattern.case}"""
    {named} = SUBJECT.node_type.function({pattern.given})
    assert {found} == {pattern.expected}
'''


def title(name: str) -> str:
    """Return a node's name as the first words of a sentence."""
    return name.replace("_", " ").capitalize()
