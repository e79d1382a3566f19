# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: seconds (timed).

The default run on one core, beside the time that the paper states.
"""

import re

from shared.figure import Figure, Table
from shared.measures import wall_clock
from shared.paper_numbers import compare, numbers
from shared.runs import Run

SECONDS = numbers("B.section_7_cost")["seconds"]
RUN = Run("B-T1", "default", "stent_artery", "stent_artery/default.prm", cost=4)


def table():
    rows = [["whole run", f"{wall_clock(RUN):.2f}", f"{SECONDS}"]]
    text = RUN.results.log
    for section in ("steps", "fields and checkpoints", "energy ledger"):
        seconds = re.search(rf"^\| {section} +\| +\d+ \| +([0-9.e+-]+)s", text, re.M).group(1)
        rows.append([section, f"{float(seconds):.2f}", "-"])
    return Table(["", "ours (s)", "paper (s)"], rows)


def checks():
    return [compare("B.section_7_cost.seconds", wall_clock(RUN))]


FIGURE = Figure("B-T1", __doc__, [RUN], None, checks, timed=True, table=table)
