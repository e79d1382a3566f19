# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of both figures of the spectral radii: the run, curves of HHT, orders."""

import matplotlib.pyplot as plt
import numpy as np

from shared.runs import Run

ALPHAS = (0.02, -0.02, 0.05, -0.05, 0.1, -0.1)
SPECTRUM = Run("C-3", "spectral_radius", "spectral_radius", table="spectral_radii.csv")
# A colour for each |alpha|; full lines for alpha > 0, dashed for alpha < 0.
COLOURS = {0.02: "#0072B2", 0.05: "#009E73", 0.1: "#D55E00"}


def hht(alpha):
    """The name of HHT's columns in the tables of the program."""
    return f"HHT {alpha:g}"


def radius_axes():
    figure, axes = plt.subplots(figsize=(6.8, 4.2))
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tilde\omega = \omega^2 \Delta t^2$")
    axes.set_ylabel(r"spectral radius $\rho(\mathbf{A})$")
    axes.set_xlim(1e-3, 1e7)
    return figure, axes


def plot_hht(axes, table, alphas):
    for alpha in alphas:
        axes.plot(
            table["omega_tilde"],
            table[hht(alpha)],
            color=COLOURS[abs(alpha)],
            linestyle="-" if alpha > 0 else "--",
            linewidth=1.5,
            label=rf"HHT, $\tilde\alpha = {alpha:g}$",
        )


def order_of(scheme):
    """Observed order on an oscillator between the two smallest time steps."""
    table = SPECTRUM.read("oscillator_order.csv")
    step, error = table["time_step"], table[scheme]
    smallest, next_smallest = np.argsort(step)[:2]
    return np.log(error[next_smallest] / error[smallest]) / np.log(
        step[next_smallest] / step[smallest]
    )
