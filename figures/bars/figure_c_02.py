# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mass matrices of linear elements.

A bar of 20 linear elements that may touch an obstacle at x = 0. Above: the mass of each node, the
sum of its row, which the consistent and the lumped matrix have in common. The redistributed matrix
takes the first node's mass away and adds to the others so that mass, centre of mass and moment of
inertia stay. Below: the first rows and columns of the matrices, in units of h.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.meshes import read_bar
from shared.paper_numbers import compare

from .common import BLUE, ORANGE, SD_FIELDS

CELLS = 20
H = 1 / CELLS
NODES = np.linspace(0, 1, CELLS + 1)


def consistent():
    mass = np.zeros((CELLS + 1, CELLS + 1))
    for k in range(CELLS):
        mass[k : k + 2, k : k + 2] += H / 6 * np.array([[2, 1], [1, 2]])
    return mass


def lumped():
    return np.diag(consistent().sum(axis=1))


def moment_matrices():
    """Symmetrised products of 1 and x about the middle, on the entries of the mass matrix."""
    x = NODES - 0.5
    ones = np.ones_like(x)
    return [
        0.5 * (np.outer(ones, ones) + np.outer(ones, ones)),
        0.5 * (np.outer(x, ones) + np.outer(ones, x)),
        np.outer(x, x),
    ]


def redistributed():
    """The nearest matrix without inertia in the first node and with the same moments."""
    mass = consistent()
    free = mass != 0
    free[0, :] = free[:, 0] = False
    result = np.where(free, mass, 0)
    moments = [np.where(free, moment, 0) for moment in moment_matrices()]
    gram = np.array([[np.sum(a * b) for b in moments] for a in moments])
    missing = [np.sum((mass - result) * moment) for moment in moment_matrices()]
    return result + np.tensordot(np.linalg.solve(gram, missing), moments, axes=1)


MATRICES = {"consistent": consistent, "lumped": lumped, "redistributed": redistributed}


def draw():
    figure = plt.figure(figsize=(6.8, 5.6), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1.15, 1))
    above = figure.add_subplot(grid[0, :])
    for matrix, label, colour, marker in (
        (consistent(), "consistent and lumped", BLUE, "o"),
        (redistributed(), "redistributed", ORANGE, "x"),
    ):
        above.plot(
            NODES, matrix.sum(axis=1) / H, marker, color=colour, label=label, markersize=6, mew=1.6
        )
    above.set(xlabel="node at x (m)", ylabel="mass of the node / h", ylim=(-0.08, 1.3))
    above.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    shown = 5
    for column, (name, matrix) in enumerate(MATRICES.items()):
        panel = figure.add_subplot(grid[1, column])
        entries = matrix()[:shown, :shown] / H
        panel.imshow(entries, cmap="Blues", vmin=0, vmax=1.4)
        for i, j in np.ndindex(shown, shown):
            value = entries[i, j]
            text = f"{value:.2f}" if abs(value) > 1e-12 else "0"
            panel.text(
                j,
                i,
                text,
                ha="center",
                va="center",
                fontsize=9,
                color="0.6" if text == "0" else "k",
            )
        panel.set_title(name)
        panel.set(xticks=[], yticks=[])
        panel.grid(False)
    return figure


def checks():
    moments, matrices = moment_matrices(), {name: f() for name, f in MATRICES.items()}
    kept = max(
        abs(np.sum((matrices["redistributed"] - matrices["consistent"]) * m)) for m in moments
    )
    lumped_inertia = np.sum((matrices["lumped"] - matrices["consistent"]) * moments[2])
    sums = {name: matrix.sum(axis=1) for name, matrix in matrices.items()}
    rows = [
        compare("C.figure_2.elements", CELLS),
        compare("C.figure_2.end_node", sums["consistent"][0] / sums["consistent"][10]),
        compare("C.figure_2.contact_node", abs(sums["redistributed"][0])),
        compare("C.figure_2.moments", kept),
        check(
            "lumped: change of the moment of inertia, over h^2/6",
            f"{lumped_inertia / (H**2 / 6):.6f}",
            abs(lumped_inertia / (H**2 / 6) - 1) < 1e-9,
            "1e-9",
            exact="1",
        ),
    ]
    # The program has made the same matrix: the kinetic energies of its velocities.
    table = SD_FIELDS.read()
    differences = []
    for step in range(0, 241, 10):
        velocity = read_bar(SD_FIELDS.field_file(step))[2]
        ours = 0.5 * velocity @ matrices["redistributed"] @ velocity
        differences.append(abs(ours - table["kinetic_energy"][step]))
    rows.append(
        check(
            "kinetic energy of a run's velocities, by this matrix and by the program's (J)",
            f"{max(differences):.1e}",
            max(differences) < 1e-7,
            "differ by < 1e-7 of 0.125 J: fields have single precision",
            exact="0",
        )
    )
    return rows


FIGURE = Figure("C-2", __doc__, [SD_FIELDS], draw, checks)
