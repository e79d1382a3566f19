#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slow impacts beside Hertz, and a spin beside that of rigid spheres, as tables.

A ball of radius R and mass m that hits a rigid plane at the speed v, or two such balls at
v each (there R, m, v and E* are those of both together): the approach d obeys m d'' =
-K d^(3/2) with K = 4/3 E* sqrt(R), so that its largest value is d = (5 m v^2 / (4 K))^(2/5),
the largest force K d^(3/2), and they touch for 2.9432 d/v (Johnson, Contact Mechanics,
1985, section 11.4). The theory takes the balls for half-spaces, right to a/R, the
radius of contact by that of the ball: 4 % here.

When the force is largest, the balls are pressed as if at rest: the pressure in the nodes is
fitted by Hertz's half ellipsoid, p^2 = p_0^2 (1 - r^2/a^2), within 0.9 of the radius of
contact, and a and p_0 are compared with a = (3 F R / (4 E*))^(1/3), p_0 = 3 F / (2 pi a^2).

Force, duration, radius, pressure, spin and tangential velocity must be within 3 %, for straight
cells, whose ball lacks 4 % of its mass, within 5 %; the duration of mortar contact, which begins
when the mean gap around a node closes, within 4 %.
"""

import argparse
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from shared import CHECKOUT, interpreter

interpreter.need("numpy")

import numpy as np  # noqa: E402

from ricochet import read_table  # noqa: E402
from ricochet.fields import array, array_of_points  # noqa: E402
from ricochet.results import read_fields  # noqa: E402

FILES = CHECKOUT / "parameter_files"


def run(program, file, parameters=(), look_at=None):
    """The table of the ledger, and the log; and the results of @p look_at, if given, for the fields
    that are written every 23 steps."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            str(program),
            str(file),
            "--output-dir",
            folder,
            "--set",
            f"Output/Fields every={23 if look_at else 0}",
            "--set",
            "Output/Log every=0",
        ]
        for parameter in parameters:
            command += ["--set", parameter]
        log = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        ledger = read_table(pathlib.Path(folder) / "energy.csv")
        return (ledger, log, look_at(pathlib.Path(folder))) if look_at else (ledger, log)


def radius_and_pressure(folder, radius):
    """Radius and peak of the half ellipsoid that fits the pressure of step 23, in nodes within @p
    radius (m)."""
    grid = read_fields(folder / "solution/step-000023.vtu")
    pressure = array(grid, "contact_pressure")[:, 0]
    points = array_of_points(grid)
    distance = np.hypot(points[:, 1], points[:, 2])
    # Each node once: cells have their own copies.
    nodes = np.unique(
        np.column_stack([distance, pressure])[(pressure > 0) & (distance < radius)].round(9), axis=0
    )
    square = np.column_stack([np.ones(len(nodes)), -(nodes[:, 0] ** 2)])
    (of_peak, falls), *_ = np.linalg.lstsq(square, nodes[:, 1] ** 2, rcond=None)
    return math.sqrt(of_peak / falls), math.sqrt(of_peak)


def hertz(modulus, radius, mass, speed):
    """Largest force and duration."""
    stiffness = 4 / 3 * modulus * math.sqrt(radius)
    approach = (5 * mass * speed**2 / (4 * stiffness)) ** 0.4
    return stiffness * approach**1.5, 2.9432 * approach / speed


def radius_of_contact(force):
    """Hertz' values for the two balls of colliding_spheres, pressed by @p force (N)."""
    return (3 * force * 0.5 / (4 * 1e6 / (2 * (1 - 0.09)))) ** (1 / 3)


# Cases of two balls: name, coupling, degree, curved cells, smallest cells (m).
TWO_BALLS = (
    ("points", "points", 1, "false", 0.016),
    ("points", "points", 1, "false", 0.008),
    ("dual mortar", "dual mortar", 1, "false", 0.008),
    ("points, curved cells of degree 2", "points", 2, "true", 0.032),
)


def duration(ledger, force):
    """Between the times at which 1/200 of the largest force is passed."""
    time, least = ledger["time"], max(force) / 200

    def passed(n):
        return time[n] + ((least - force[n]) / (force[n + 1] - force[n]) * (time[n + 1] - time[n]))

    first = next(n for n in range(len(force)) if force[n + 1] > least)
    last = max(n for n in range(len(force) - 1) if force[n] > least)
    return passed(last) - passed(first)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default=str(CHECKOUT / "build/release"))
    parser.add_argument(
        "--quick", action="store_true", help="one mesh of the ball on curved cells only"
    )
    arguments = parser.parse_args()
    programs = pathlib.Path(arguments.build_dir)
    failed = []

    def row(name, log, values, bound):
        unknowns = re.search(r"(\d+) unknowns", log).group(1)
        parts = []
        for computed, expected in values:
            error = computed / expected - 1
            parts.append(f"{computed:.4g} ({100 * error:+.1f} %)")
            if abs(error) > bound:
                failed.append(name)
        print(f"| {name} | {unknowns} | " + " | ".join(parts) + " |", flush=True)

    # E = mu (3 lambda + 2 mu) / (lambda + mu) = 50, nu = 1/4.
    force, time = hertz(50 / (1 - 1 / 16), 20, 4 / 3 * math.pi * 20**3, 1.18e-3)
    print(
        f"| impact | unknowns | largest force ({force:.4g}) | duration ({time:.4g}) "
        "| energy in vibrations |\n|---|---|---|---|---|"
    )
    for size in (0.16,) if arguments.quick else (0.32, 0.16, 0.08):
        for curved in ("true",) if arguments.quick else ("false", "true"):
            ledger, log = run(
                programs / "sphere",
                FILES / "sphere/hertz.prm",
                [f"Mesh/Mesh size where it touches={size}", f"Mesh/Curved cells={curved}"],
            )
            row(
                f"ball on a plane, {'curved' if curved == 'true' else 'straight'}, " f"{size} m",
                log,
                (
                    (max(ledger["contact_force_foundation"]), force),
                    (duration(ledger, ledger["contact_force_foundation"]), time),
                ),
                0.03 if curved == "true" else 0.05,
            )
            print(
                f"  left in vibrations: "
                f"{ledger['elastic_energy'][-1] / ledger['energy'][0]:.1e}"
            )
    if arguments.quick:
        sys.exit(1 if failed else 0)

    force, time = hertz(1e6 / (2 * (1 - 0.09)), 0.5, 1000 * 2 / 3 * math.pi, 2 * 5.366e-3)
    print(f"two balls: largest force {force:.4g} N, duration {time:.4g} s")
    for name, coupling, degree, curved, size in TWO_BALLS:
        ledger, log, (a, peak) = run(
            programs / "colliding_spheres",
            FILES / "colliding_spheres/hertz.prm",
            [
                f"Contact/Coupling={coupling}",
                f"Spheres/Degree={degree}",
                f"Spheres/Curved cells={curved}",
                f"Spheres/Mesh size where they touch={size}",
            ],
            lambda folder: radius_and_pressure(folder, 0.9 * radius_of_contact(force)),
        )
        forces = ledger["contact_force_spheres"]
        row(
            f"two balls, {name}, {size} m",
            log,
            ((max(forces), force), (duration(ledger, forces), time)),
            0.03 if coupling == "points" else 0.04,
        )
        # Hertz' values for the force of that step.
        exact = radius_of_contact(forces[23])
        values = ((a, exact), (peak, 1.5 * forces[23] / (math.pi * exact**2)))
        print(
            "  radius and peak of the pressure: "
            + ", ".join(f"{x:.5g} ({100 * (x / y - 1):+.1f} %)" for x, y in values)
        )
        # Points act on single nodes, whose pressures oscillate.
        if coupling != "points" and any(abs(x / y - 1) > 0.03 for x, y in values):
            failed.append(f"pressure of {name}, {size} m")

    # Impulse of friction over that of the pressure: for rigid spheres that slide it is mu, and the
    # spin is 5/2 of that by the radius.
    ledger, log = run(programs / "colliding_spheres", FILES / "colliding_spheres/sliding_spin.prm")
    change = {c: ledger[f"momentum_{c}_right"][-1] - ledger[f"momentum_{c}_right"][0] for c in "xy"}
    velocity = float(re.search(r"velocity_x_right +(\S+)", log).group(1)) + 1
    spin = float(re.search(r"spin_z_right +(\S+)", log).group(1))
    row(
        "sliding spin: tangential impulse by 0.1 normal, spin by its rigid one",
        log,
        ((change["y"] / (0.1 * change["x"]), 1.0), (spin / (-2.5 * 0.1 * velocity), 1.0)),
        0.03,
    )
    ledger, log = run(
        programs / "colliding_spheres",
        FILES / "colliding_spheres/sliding_spin.prm",
        ["Contact/Friction coefficient=1", "Spheres/Spin of the left sphere=0, 0, 2"],
    )
    value = {
        name: float(re.search(rf"{name} +(\S+)", log).group(1))
        for name in ("velocity_y_left", "velocity_y_right", "spin_z_left", "spin_z_right")
    }
    left = value["velocity_y_left"] + value["spin_z_left"]
    right = value["velocity_y_right"] - value["spin_z_right"]
    print(
        "sticking: the surfaces slide on each other at 2 m/s before and at "
        f"{left - right:.2f} m/s after it"
    )
    if failed:
        sys.exit("not within the bounds: " + ", ".join(failed))


if __name__ == "__main__":
    main()
