# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that the site makes itself, of a few seconds each: one of each tutorial's program, to turn and
to play in a browser, and an impact of the ball with each treatment of contact."""

from __future__ import annotations

import pathlib
import warnings
from collections.abc import Mapping

from ricochet import OpenRun, Run, page, pictures, programs

from . import site

#: Frames of a page, which is then some megabytes long.
FRAMES = 30

FILES = site.ROOT / "parameter_files"

#: The runs of the tutorials: a parameter file of the program, and what is set in it.
TUTORIALS: dict[str, tuple[str, dict[str, object]]] = {
    "elastic_ball": ("impact_1ms.prm", {"Output/Fields every": 2}),
    "hyperelastic_ring": ("default.prm", {"Output/Fields every": 5}),
    "sphere": ("default.prm", {}),
    "obstacle_course": ("default.prm", {}),
    "colliding_disks": ("default.prm", {}),
    "colliding_spheres": ("default.prm", {}),
    "sliding_block": ("default.prm", {}),
    "stent_artery": ("default.prm", {}),
}


def _task(
    made: site.Site, name: str, program: str, file: pathlib.Path, overrides: Mapping[str, object]
) -> programs.Task:
    binary = made.programs / program
    own = {"Output/Log every": 0, **overrides}
    inputs = programs.checksum_of_build(binary) + programs.checksum_of_inputs(
        binary, programs.checksum_of_file(file), own
    )
    return programs.Task(name, binary, file, own, made.runs / name, inputs=inputs)


def _make(tasks: list[programs.Task]) -> dict[str, Run]:
    """Make those that are not there; return all by their names.

    Raises:
        SiteError: one of them fails.
    """
    with warnings.catch_warnings():
        # Methods whose energy is not kept have a page, too.
        warnings.simplefilter("ignore", OpenRun)
        outcomes = programs.run_missing(tasks)
    for outcome in outcomes:
        if outcome.run is None:
            raise site.SiteError(f"The run {outcome.name} of the site failed: {outcome.error}")
    return {outcome.name: outcome.run for outcome in outcomes if outcome.run}


def of_treatments(made: site.Site, treatments: list[str]) -> dict[str, Run]:
    """The impact of the elastic ball with steps of 1 ms, by treatments."""
    file = FILES / "elastic_ball" / "impact_1ms.prm"
    return _make(
        [
            _task(
                made,
                name,
                "elastic_ball",
                file,
                {"Contact/Treatment": name, "Output/Fields every": 0},
            )
            for name in treatments
        ]
    )


def of_tutorials(made: site.Site) -> dict[str, str]:
    """Write the pages of the tutorials' runs; return their names in the site, by programs."""
    tasks = [
        _task(made, program, program, FILES / program / file, overrides)
        for program, (file, overrides) in TUTORIALS.items()
    ]
    names = {}
    for program, run in _make(tasks).items():
        names[program] = f"runs/{program}.html"
        page.write(run, made.extra(names[program]), "von_mises", pictures.palette(), FRAMES)
    return names
