# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of runs to turn and play in a browser, of those that are in output/."""

from __future__ import annotations

from ricochet import Run, page, pictures
from ricochet.errors import RicochetError

from . import site

#: Frames of a page, which is then some megabytes long.
FRAMES = 30


def write(made: site.Site, program: str) -> str | None:
    """Write the page of the first run of a program with fields of bodies; return its name in the site.

    None where there is no such run: the site can be made before any.
    """
    for folder in sorted((made.output / program).glob("*/")):
        name = f"runs/{program}.html"
        try:
            page.write(Run(folder), made.extra(name), "von_mises", pictures.palette(), FRAMES)
        except RicochetError:
            continue
        return name
    return None
