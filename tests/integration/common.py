# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common functions of all integration tests: run a program, read its ledger."""

import argparse
import csv
import functools
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]

# The contact treatments that every one-step collocation scheme takes.
TREATMENTS = [
    "Nitsche",
    "penalty",
    "proximal augmented Lagrangian",
    "Signorini multipliers",
    "Signorini active set",
]

# Names of the schemes in the tests, and the parameters that make them.
SCHEMES = {
    "CN": ["Time/Scheme=Crank-Nicolson"],
    "HHT 0.05": ["Time/Scheme=HHT", "Time/HHT alpha=0.05"],
    "HHT -0.02": ["Time/Scheme=HHT", "Time/HHT alpha=-0.02"],
    "generalised-alpha": ["Time/Scheme=generalised-alpha"],
    "TR-BDF2": ["Time/Scheme=TR-BDF2"],
    "BDF2": ["Time/Scheme=BDF2"],
    "midpoint": ["Time/Scheme=midpoint"],
}

# The treatments of papers A and B, for the midpoint scheme and free bodies.
# Those that keep the energy itself, those that keep it together with their
# potential, and those that only lose.
KEEP_ENERGY = ["persistent contact", "Ayyad-Barboteu two-step"]
KEEP_MODIFIED_ENERGY = ["improved normal compliance", "Hauret-Le Tallec"]
LOSE_ENERGY = ["Signorini active set", "Signorini multipliers",
               "standard normal compliance", "penalty"]

# A small elastic ball just before its impact, in the middle of a step, and a
# small hyperelastic ring.
BALL = ["Mesh/Nodes=392", "Mesh/Boundary nodes=64", "Start/Initial gap=0.0155",
        "Time/Time step=1e-3", "Time/Final time=0.04"]
RING = ["Mesh/Nodes around=64", "Mesh/Nodes across=4", "Start/Initial gap=0.155",
        "Time/Time step=1e-2", "Time/Final time=0.5"]

NO_FIELDS = ["Output/Fields every=0", "Output/Log every=0"]

# Columns that are round-off by themselves, and counts that can differ by one where a
# residual sits at the tolerance.
NOISE = ("newton_iterations", "linear_solves", "solver", "outer_iterations",
         "inner_iterations", "tangents", "balance_residual", "promise_residual",
         "round_off")

arguments = None


def is_part_of_energy(name):
    """Whether a column may be the round-off of energies: conserved quantities, and gains of
    conserving contact."""
    return name == "total_energy" or name.startswith("contact_gain_")


def program_path(program):
    return str(pathlib.Path(arguments.programs).resolve() / program)


class Ledger:
    """The columns of an energy.csv, by name without unit."""

    def __init__(self, folder):
        with open(pathlib.Path(folder) / "energy.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.names = [cell.split(" [")[0] for cell in rows[0]]
        self.units = [cell.split(" [")[1].rstrip("]") for cell in rows[0]]
        values = [[float(x or "nan") for x in row] for row in rows[1:]]
        self.columns = dict(zip(self.names, zip(*values)))

    def __getitem__(self, name):
        return self.columns[name]


class ProgramTest(unittest.TestCase):
    """Gives each test a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ricochet-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        begin = time.monotonic()
        self.addCleanup(lambda: print(f"{time.monotonic() - begin:.1f} s", end=" ",
                                      file=sys.stderr))

    def command(self, program, parameters=(), folder=None, options=(), prm=None,
                n_ranks=1):
        words = [] if n_ranks == 1 else [arguments.mpiexec, "-n", str(n_ranks)]
        words.append(program_path(program))
        if prm is not None:
            words.append(str(prm))
        for parameter in parameters:
            words += ["--set", parameter]
        words += ["--output-dir", str(folder or self.folder / "run")]
        return words + list(options)

    def attempt(self, *args, **kwargs):
        """Run; return exit code, standard output and error."""
        result = subprocess.run(self.command(*args, **kwargs),
                                capture_output=True, text=True, timeout=600,
                                cwd=ROOT)
        return result.returncode, result.stdout, result.stderr

    def run_program(self, program, parameters=(), folder=None, promise_off_by=None,
                    **kwargs):
        """Run, insist on success, return the ledger. Whatever another test case
        has left in the folder is overwritten. A promise that is known to be broken is
        so by promise_off_by, within a factor of three."""
        folder = folder or self.folder / "run"
        if "--resume" not in kwargs.get("options", ()):
            kwargs["options"] = [*kwargs.get("options", ()), "--overwrite"]
        code, out, err = self.attempt(program, parameters, folder, **kwargs)
        self.assertEqual(code, 4 if promise_off_by else 0,
                         msg=f"{program} {parameters}\n{out}\n{err}")
        ledger = Ledger(folder)
        if promise_off_by:
            residual = max(ledger["promise_residual"])
            self.assertLess(residual, 3. * promise_off_by)
            self.assertGreater(residual, promise_off_by / 3.)
        return ledger

    def copy_of_shared_run(self, program, parameters):
        """A copy, in the folder "run" of this test, of a run that is made once for all
        tests of its class."""
        cls = type(self)
        if "shared_run" not in vars(cls):
            cls.shared_run = pathlib.Path(tempfile.mkdtemp(prefix="ricochet-"))
            cls.addClassCleanup(shutil.rmtree, cls.shared_run, ignore_errors=True)
            self.run_program(program, parameters, cls.shared_run)
        shutil.copytree(cls.shared_run, self.folder / "run")

    def run_many(self, cases):
        """Run (name, program, parameters) on two cores; yield (name, ledger). A fourth
        entry is promise_off_by of run_program()."""
        def run(numbered):
            number, (name, program, parameters, *promise_off_by) = numbered
            return name, self.run_program(program, parameters,
                                          self.folder / f"case-{number}",
                                          *promise_off_by)
        with ThreadPoolExecutor(max_workers=2) as pool:
            yield from pool.map(run, enumerate(cases))


def largest(values):
    """Not a number if one of them is none."""
    values = [abs(value) for value in values]
    return next((value for value in values if value != value), max(values))


def increments(values):
    return [b - a for a, b in zip(values, values[1:])]


@functools.cache
def is_debug_build():
    """Debug programs are several times slower: tests shorten their runs."""
    result = subprocess.run([program_path("bar_sd"), "--version"],
                            capture_output=True, text=True)
    return "(Debug)" in result.stdout


def main():
    global arguments
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True,
                        help="folder of the built programs")
    parser.add_argument("--mpiexec", default="mpirun")
    arguments, rest = parser.parse_known_args()
    # The test modules import this file under another name than __main__.
    sys.modules["common"].arguments = arguments
    # As ctest sets them: Open MPI as root and with more ranks than cores.
    for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                 "OMPI_MCA_rmaps_base_oversubscribe", "OPENBLAS_NUM_THREADS",
                 "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    unittest.main(module="__main__", argv=[sys.argv[0]] + rest, verbosity=2)
