# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the programs of Ricochet and read their results, from Python.

    import ricochet

    run = ricochet.run("elastic_ball", "parameter_files/elastic_ball/impact_1ms.prm",
                       {"Contact/Treatment": "persistent contact"}, output="output/mine")
    print(run.summary())
    run.energy.plot(x="time", y="energy")      # a pandas.DataFrame
    grid = run.fields(0.02)                    # a VTK grid

    ricochet.Run("output/x")                   # an earlier run
    ricochet.sweep("bar_sd", overrides={"Time/Time step": [0.1, 0.05, 0.025]})

The commands `ricochet-plot` and `ricochet-compare` are made of the same parts. NumPy is
needed by all; pandas by `Run.energy`, h5py by energy.h5, xarray by `Run.to_xarray`, VTK by fields,
matplotlib by drawings, each when it is used.
"""

from .errors import (
    BadParameterFile,
    Failed,
    NotARun,
    OpenRun,
    ProgramError,
    Refused,
    RicochetError,
)
from .measures import ContactMeasures, Summary
from .names import NoSuchName
from .programs import Outcome, find_program, parameters_of, run, sweep
from .results import FieldFile, Run
from .sampling import dataset, frame, samples
from .tables import Table, read_table

__all__ = [
    "BadParameterFile",
    "ContactMeasures",
    "Failed",
    "FieldFile",
    "NoSuchName",
    "NotARun",
    "OpenRun",
    "Outcome",
    "ProgramError",
    "Refused",
    "RicochetError",
    "Run",
    "Summary",
    "Table",
    "dataset",
    "find_program",
    "frame",
    "parameters_of",
    "read_table",
    "run",
    "samples",
    "sweep",
]
