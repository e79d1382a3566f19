# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the elastic ball: runs of the methods, with bands."""

from shared.methods import EMM, HAURET, INC, PERSISTENT, SIGNORINI, SNC, TWO_STEP, band
from shared.runs import QUIET, Run

# Contents of the parameter files impact_*.prm: time step (s), initial gap (m), and the
# whole steps in that gap.
STEP = {"0.1ms": (1e-4, 0.0055, 5), "1ms": (1e-3, 0.055, 5), "10ms": (1e-2, 0.15, 1)}
AGAINST = "time since the ball touches (ms)"


def run(figure, key, file=None, overrides=(), cost=1.0):
    return Run(
        figure,
        key,
        "elastic_ball",
        f"elastic_ball/figure_{figure[0]}{int(figure[2:]):02}_{file or key}.prm",
        (*QUIET, *overrides),
        cost=cost,
    )


def positions(one, step):
    time_step, _, steps = STEP[step]
    return band(one, steps, time_step, one.cost)


METHODS_A = (SIGNORINI, SNC, EMM, TWO_STEP, INC[2], PERSISTENT)
METHODS_B = (SIGNORINI, SNC, EMM, TWO_STEP, HAURET, PERSISTENT)

FINE = {method.key: run("A-4", method.key) for method in METHODS_A}
FINE["hauret"] = run("B-4", "hauret")
FINE.update({INC[alpha].key: run("A-9", INC[alpha].key) for alpha in (3, 4, 5)})
FINE_BAND = {key: positions(one, "1ms") for key, one in FINE.items()}

COARSE = {INC[alpha].key: run("A-8", INC[alpha].key) for alpha in (2, 3, 4, 5)}
COARSE["snc"] = run("A-8", "snc")
COARSE_BAND = {key: positions(one, "10ms") for key, one in COARSE.items()}


def with_bands(methods, runs, bands):
    return [r for m in methods for r in (runs[m.key], *bands[m.key])]
