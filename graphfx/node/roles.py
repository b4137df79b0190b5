"""What the engine does with a node of each role, in words."""

from __future__ import annotations

ROLES = {
    "assign": "sets what it gives at its moment, which `when` names",
    "flow": "takes it as the exact change over dt, and composes flows symmetrically around each other",
    "linear": "sums all linear parts and takes them in one exact step",
    "acceleration": "integrates it together with all other accelerations",
    "velocity": "integrates it as an applied velocity, besides the particle's own",
    "surface": "finds the instant of each contact, and answers it there",
    "geometry": "makes the mesh before the cook, and moves it where it stands at each step",
    "noise": "draws it for each particle: held for each 1/24 s, or Brownian; steps and frames change nothing of what is drawn",
    "pairs": "sums it over the neighbours that are near",
    "value": "finds it for the parameter or attribute that it is given to",
    "selector": "lets through the particles for which it is true: in a stream, or as `only` of an operator",
}


def treatment(role: str) -> str:
    """Return what the engine does with a node of a role; whatever is not here is part of the language."""
    return ROLES.get(role, "carries it out itself")
