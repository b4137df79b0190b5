"""What every node must keep: documented, in range, the same on the machine as in plain Python, finite, true to its role.

    @pytest.mark.parametrize("truth", truths_of(subject("drift", "library")))
    def test_drift_keeps_the_contract(truth): ...

A test of your own nodes asks for their truths and calls each; what is wrong is an AssertionError that says with
which numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from graphfx.contract import claims, cooked, truths
from graphfx.contract.subject import Subject
from graphfx.node import Library, library_roots

__all__ = ["Subject", "Truth", "subject", "truths_of"]

Truth = Callable[[Subject], None]
ALL: tuple[Truth, ...] = (truths.is_documented, truths.has_defaults_in_range, cooked.cooks)
OF_FUNCTIONS: tuple[Truth, ...] = (truths.machine_is_plain_python, truths.stays_finite, truths.does_not_depend_on_order)
OF_ROLES: tuple[Truth, ...] = claims.ALL


def subject(name: str, library: Iterable[str | Path] | str | Path = ()) -> Subject:
    """Return a node type of some library folders, or of those that come with graphfx, ready to be tested."""
    folders = [library] if isinstance(library, str | Path) else list(library)
    found = Library(library_roots(folders))
    return Subject(found[name], found)


def _of_the_flow(truth: Truth) -> Truth:
    """Return a truth of a node's function as one of its exact flow."""

    def of_the_flow(subject: Subject) -> None:
        assert subject.whole is not None
        truth(subject.whole)

    of_the_flow.__name__, of_the_flow.__doc__ = f"flow_{truth.__name__}", f"Of its exact flow: {truth.__doc__}"
    return of_the_flow


def truths_of(subject: Subject) -> list[Truth]:
    """Return all that must be true of a node: functions, whose names and docs say what."""
    claimed = [truth for truth in OF_ROLES if claims.applies(subject, truth)]
    if subject.is_shape:
        claimed.append(truths.makes_sound_meshes)
    if subject.draws:
        claimed.append(truths.stays_finite_at_the_ends_of_draws)
    if subject.whole is not None:
        claimed += [_of_the_flow(truth) for truth in (truths.machine_is_plain_python, truths.stays_finite)]
    return [*ALL, *(OF_FUNCTIONS if subject.is_function else ()), *claimed]
