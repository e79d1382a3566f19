# SPDX-License-Identifier: LGPL-2.1-or-later
"""The two bars, and the exact motion of their ends."""

from dataclasses import dataclass

import numpy as np

FINAL_TIME = 12.0  # s
GAMMA_N = 5 / 0.05  # Pa/m, gamma_0/h


@dataclass(frozen=True)
class End:
    """Exact motion of an end of the bar: piecewise linear and periodic.

    The motion is written down here from the characteristics, independently of the program's own, so
    that one checks the other.
    """

    name: str
    displacement: tuple  # m, at t = 0, 1, ..., period
    pressure: tuple  # Pa, constant between these times

    @property
    def period(self):
        return len(self.pressure)

    @property
    def velocity(self):
        return np.diff(self.displacement)

    def displacement_at(self, time):
        return np.interp(np.mod(time, self.period), range(self.period + 1), self.displacement)

    def piecewise(self, values, time):
        return np.asarray(values)[np.floor(np.mod(time, self.period)).astype(int)]

    def steps(self, values):
        """Corners of the graph of a piecewise constant function, with its jumps."""
        n = int(FINAL_TIME)
        return np.repeat(np.arange(n + 1), 2)[1:-1], np.repeat(np.resize(values, n), 2)


@dataclass(frozen=True)
class Bar:
    """A benchmark: its program, its exact solution."""

    name: str
    program: str
    ends: tuple
    energy: float  # J, at all times

    # In both benchmarks the initial strain -1/2 stands at the free left end,
    # where the exact solution drops it at once. Nitsche's modified energy
    # starts with this inconsistency: C (13) gives E - sigma_n^2/(2 gamma_N).
    @property
    def initial_modified_energy(self):
        return self.energy - 0.5**2 / (2 * GAMMA_N)


SD = Bar("1D-SD", "bar_sd", (End("left", (0.5, 0, 0, 0.5), (0, 0.5, 0)),), 1 / 8)
SS = Bar(
    "1D-SS",
    "bar_ss",
    (
        End("left", (1, 0, 0, 0, 0, 1, 1), (0, 0, 1, 0, 0, 0)),
        End("right", (0.5, 0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (0, 0, 0, 0, 0, 1)),
    ),
    1 / 4,
)
