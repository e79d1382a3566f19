# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a program and reads the timings at the end of its log."""

import csv
import math
import os
import pathlib
import re
import resource
import subprocess
import tempfile

SHARES = re.compile(r"residuals (\S+) s, tangents (\S+) s, (\d+) factorisations "
                    r"(\S+) s, back-substitutions (\S+) s")


def measure(program, parameters, parameter_file=None, n_ranks=1, n_threads=1):
    """Unknowns, steps, iterations, seconds in all steps, the timings of a run, seconds of the
    processors in all of it, and the memory of all ranks (MB)."""
    with tempfile.TemporaryDirectory() as folder:
        command = [] if n_ranks == 1 else ["mpirun", "-n", str(n_ranks)]
        command += [program] + ([parameter_file] if parameter_file else [])
        command += ["--output-dir", folder]
        for parameter in parameters + ["Output/Fields every=0",
                                       "Output/Log every=0"]:
            command += ["--set", parameter]
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1",
                       "DEAL_II_NUM_THREADS": "1", "OMP_NUM_THREADS": str(n_threads)}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        log = subprocess.run(command, check=True, capture_output=True,
                             text=True, env=environment).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(pathlib.Path(folder) / "energy.csv", newline="") as file:
            rows = list(csv.reader(file))
    column = next(i for i, name in enumerate(rows[0])
                  if name.startswith("newton_iterations"))
    steps, seconds = re.search(r"\| steps +\| +(\d+) \| +(\S+?)s \|",
                               log).groups()
    residual, tangent, count, factorisation, substitution = SHARES.search(
        log).groups()
    return {"unknowns": int(re.search(r"(\d+) unknowns", log).group(1)),
            "steps": int(steps),
            "iterations": sum(float(row[column]) for row in rows[1:]),
            "seconds": float(seconds), "residuals": float(residual),
            "tangents": float(tangent), "factorisations": int(count),
            "factorising": float(factorisation),
            "substituting": float(substitution),
            "cpu": (after.ru_utime + after.ru_stime - before.ru_utime -
                    before.ru_stime),
            "solver": re.search(r"linear solver: (.*)", log).group(1),
            "memory": float(re.search(r"memory at most: (\d+) MB",
                                      log).group(1))}


def exponent(points):
    """The slope through points (x, y) in logarithms: y ~ x^exponent."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) /
            sum((x - mean_x) ** 2 for x, _ in logs))
