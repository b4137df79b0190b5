"""Steps of a particle's own: how far its next one goes, by the error of the last. Scalar functions for one particle.

A step is `share` of the longest one, a power of 1/2. Its error is estimated from two results of different orders; it is
allowed `tolerance` times its length, or what rounding hides. Errors of a lower order q in the step shrink 2^q times
faster than what is allowed as a step is halved, which says how often to halve it.
[Hairer, Norsett and Wanner 1993, II.4; dyadic steps: none is a sum of rounded times]
"""

from __future__ import annotations

from typing import Any

from graphfx.math import absolute, length, maximum, minimum, where
from graphfx.motion.basic import MOTION


def weights_of(counts: tuple[int, ...]) -> tuple[list[float], list[float]]:
    """Return how the results of n_1 ... n_m equal steps are combined, all but the last: for the value and for its error.

    Value T = T_m + sum w_i (T_m - T_i) has no term of h^2 ... h^(2m-2), as the steps are symmetric; the error is its
    difference from the same made of n_2 ... n_m. [Richardson 1911; Gragg 1965]
    """

    def shares(used: tuple[int, ...]) -> dict[int, float]:
        found = {}
        for n in used:
            found[n] = 1.0
            for other in used:
                found[n] *= n * n / (n * n - other * other) if other != n else 1.0
        return found

    all_shares, fewer = shares(counts), shares(counts[1:])
    return [-all_shares[n] for n in counts[:-1]], [fewer.get(n, 0.0) - all_shares[n] for n in counts[:-1]]


@MOTION.function("vec3 vec3 vec3 float", "vec3")
def corrected(value: Any, last: Any, other: Any, weight: Any) -> Any:
    """value + (last - other) weight."""
    return value + (last - other) * weight


@MOTION.function("float float", "float")
def part_of(dt: Any, share: Any) -> Any:
    """dt share."""
    return dt * share


@MOTION.function("float", "float")
def share_of(stored: Any) -> Any:
    """The share of the longest step that a particle takes; one that was never set (0) begins with all of it."""
    return where(stored > 0.0, stored, stored + 1.0)


@MOTION.function("vec3 vec3 float float float", "float")
def hidden_error(position: Any, velocity: Any, longest: Any, share: Any, resolution: Any) -> Any:
    """What rounding hides [m]: `resolution` of the place and of a way of `longest`.

    It counts 16 times where steps have become 64 times shorter without an error as small as that: such an error is
    hardly one of the step.
    """
    size = maximum(maximum(absolute(position.x), absolute(position.y)), absolute(position.z))
    return (size + length(velocity) * longest) * (resolution * where(share < 0.015625, 16.0, 1.0))


@MOTION.function("vec3 vec3 float", "float")
def size_of_error(position: Any, velocity: Any, longest: Any) -> Any:
    """|error of P| + |error of V| longest [m]: what a wrong velocity does in one long step counts as well."""
    return length(position) + length(velocity) * longest


@MOTION.function("float float float float float float float float", "bool bool float")
def judged(
    error: Any, hidden: Any, tolerance: Any, dt: Any, longest: Any, share: Any, finest: Any, steep: Any
) -> Any:
    """Return whether a step is accepted, whether to give up, and the share of the longest step to take next.

    An error of tolerance dt is allowed, or what rounding hides. `steep` is 2^q. A step that failed by more than that is
    divided by 4, by more than its square or with no number for an error by 8. The next one is twice as long where its
    error would still be a quarter of what is allowed, or is hidden by rounding.
    """
    ratio = error / maximum(tolerance * dt, hidden)
    accepted = ratio <= 1.0
    spare = ((ratio * (steep * 4.0) <= 1.0) | (error <= hidden)) & (dt >= share * longest * 0.875)
    factor = where(ratio <= steep, 0.5, where(ratio <= steep * steep, 0.25, 0.125))
    longer, shorter = minimum(share * 2.0, 1.0), maximum(share * factor, finest)
    return accepted, ~accepted & (share <= finest), where(accepted, where(spare, longer, share), shorter)
