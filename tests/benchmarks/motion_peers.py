"""The others of `motion.py`: SciPy particle by particle, REBOUND, and the Runge-Kutta loop that one writes first with Numba.

Each takes the states at time 0, (n, 6), and a setting, and returns the states at the end with the evaluations of a particle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from motion_problems import RESILIENCE, Problem, orbit_rate
from numba import njit

Run = Callable[[np.ndarray, float], tuple[np.ndarray, float]]


def scipy_run(problem: Problem, method: str) -> Run:
    """Return a run of solve_ivp with rtol = atol = the setting; the rate of change is compiled."""
    from scipy.integrate import solve_ivp

    rate = problem.rate

    @njit
    def rates(t: float, y: np.ndarray) -> np.ndarray:
        return np.array(rate(y[0], y[1], y[2], y[3], y[4], y[5]))

    def height(t: float, y: np.ndarray) -> float:
        return float(y[1])

    height.terminal, height.direction = True, -1  # type: ignore[attr-defined]

    def run(start: np.ndarray, setting: float) -> tuple[np.ndarray, float]:
        ends, count = np.empty_like(start), 0
        given: dict[str, Any] = {"method": method, "rtol": setting, "atol": setting}
        for row, state in enumerate(start):
            then, y = 0.0, state
            while then < problem.seconds:
                if problem.ball:  # no step longer than the way up, so that none comes down in the step in which it went up
                    given |= {"events": height, "max_step": max(y[4] / 9.81, 0.1)}
                found = solve_ivp(rates, (then, problem.seconds), y, **given)
                then, y, count = found.t[-1], found.y[:, -1].copy(), count + found.nfev
                if found.status == 1:
                    y[1], y[4] = 0.0, -RESILIENCE * y[4]
                if found.status < 0:
                    y[:], then = np.inf, problem.seconds
            ends[row] = y
        return ends, count / len(start)

    return run


def loop_run(problem: Problem) -> Run:
    """Return a run of Runge-Kutta of order 4, particle by particle, with so many steps a second as the setting says."""
    rate, ball, seconds = problem.rate, problem.ball, problem.seconds

    @njit(nogil=True)
    def carry(states: np.ndarray, steps: int, dt: float) -> None:
        for i in range(len(states)):
            x, y, z, u, v, w = states[i]
            for _ in range(steps):
                a, h = rate(x, y, z, u, v, w), dt / 2
                b = rate(x + h * a[0], y + h * a[1], z + h * a[2], u + h * a[3], v + h * a[4], w + h * a[5])
                c = rate(x + h * b[0], y + h * b[1], z + h * b[2], u + h * b[3], v + h * b[4], w + h * b[5])
                d = rate(x + dt * c[0], y + dt * c[1], z + dt * c[2], u + dt * c[3], v + dt * c[4], w + dt * c[5])
                s = dt / 6
                x, y, z = (x + s * (a[0] + 2 * (b[0] + c[0]) + d[0]), y + s * (a[1] + 2 * (b[1] + c[1]) + d[1]),
                           z + s * (a[2] + 2 * (b[2] + c[2]) + d[2]))
                u, v, w = (u + s * (a[3] + 2 * (b[3] + c[3]) + d[3]), v + s * (a[4] + 2 * (b[4] + c[4]) + d[4]),
                           w + s * (a[5] + 2 * (b[5] + c[5]) + d[5]))
                if ball and y < 0 and v < 0:
                    y, v = -y * RESILIENCE, -v * RESILIENCE
            states[i] = x, y, z, u, v, w

    def run(start: np.ndarray, setting: float) -> tuple[np.ndarray, float]:
        ends, steps = start.copy(), round(setting * seconds)
        carry(ends, steps, seconds / steps)
        return ends, 4.0 * steps

    return run


def rebound_run(problem: Problem, integrator: str, together: bool) -> Run:
    """Return a run of test particles about a star: `together` in one simulation, or each in its own.

    The setting is ias15's epsilon, or the steps a second of whfast. Evaluations are not told.
    """
    import rebound
    from motion_problems import ORBIT

    assert problem.rate is orbit_rate

    def carried(rows: np.ndarray, setting: float) -> np.ndarray:
        simulation = rebound.Simulation()
        simulation.G = 1.0
        simulation.integrator = integrator
        if integrator == "ias15":
            simulation.integrator.epsilon = setting
        else:
            simulation.dt = problem.seconds / max(round(setting * problem.seconds), 1)
        simulation.add(m=ORBIT)
        simulation.N_active = 1
        for x, y, z, u, v, w in rows:
            simulation.add(x=x, y=y, z=z, vx=u, vy=v, vz=w)
        simulation.integrate(problem.seconds)
        states = np.zeros((len(rows) + 1, 3)), np.zeros((len(rows) + 1, 3))
        simulation.serialize_particle_data(xyz=states[0], vxvyvz=states[1])
        return np.hstack(states)[1:]

    def run(start: np.ndarray, setting: float) -> tuple[np.ndarray, float]:
        parts = [start] if together else [row[None] for row in start]
        return np.vstack([carried(part, setting) for part in parts]), math.nan

    return run
