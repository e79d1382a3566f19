# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), figures 3 and 4: spectral radii.

The program spectral_radius takes the amplification matrices from the very time
integrators that the benchmarks use, and the errors of a free oscillator.
"""

import matplotlib.pyplot as plt
import numpy as np

from report import Figure, check, note
from runs import Run

ALPHAS = (0.02, -0.02, 0.05, -0.05, 0.1, -0.1)

SPECTRUM = Run("C-3", "spectral_radius", "spectral_radius", table="spectral_radii.csv")

# A colour for each |alpha|; full lines for alpha > 0, dashed for alpha < 0.
COLOURS = {0.02: "#0072B2", 0.05: "#009E73", 0.1: "#D55E00"}


def hht(alpha):
    """The name of HHT's columns in the tables of the program."""
    return f"HHT {alpha:g}"


def limit(alpha):
    """Spectral radius of HHT for large omega dt, paper C, below (32)."""
    return (1 - abs(alpha)) / (1 + abs(alpha))


def _axes():
    figure, axes = plt.subplots(figsize=(7.5, 4.4))
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tilde\omega = \omega^2 \Delta t^2$")
    axes.set_ylabel(r"spectral radius $\rho(\mathbf{A})$")
    axes.set_xlim(1e-3, 1e7)
    return figure, axes


def _plot_hht(axes, table, alphas):
    for alpha in alphas:
        axes.plot(
            table["omega_tilde"],
            table[hht(alpha)],
            color=COLOURS[abs(alpha)],
            linestyle="-" if alpha > 0 else "--",
            linewidth=1.5,
            label=rf"HHT, $\tilde\alpha = {alpha:g}$",
        )


def draw_figure_3():
    table = SPECTRUM.read()
    figure, axes = _axes()
    axes.plot(table["omega_tilde"], table["Crank-Nicolson"], "0.4", label=r"$\tilde\alpha = 0$")
    _plot_hht(axes, table, ALPHAS)
    for i, magnitude in enumerate(COLOURS):
        axes.axhline(
            limit(magnitude),
            color="black",
            linewidth=0.8,
            linestyle=":",
            zorder=1,
            label="exact limit\n" r"$(1-|\tilde\alpha|)/(1+|\tilde\alpha|)$" if i == 0 else None,
        )
    axes.set_ylim(0.78, 1.01)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def draw_figure_4():
    table = SPECTRUM.read()
    figure, axes = _axes()
    axes.plot(table["omega_tilde"], table["Crank-Nicolson"], "0.4", label=r"$\tilde\alpha = 0$")
    _plot_hht(axes, table, ALPHAS)
    axes.plot(
        table["omega_tilde"],
        table["TR-BDF2"],
        color="#CC79A7",
        linewidth=2,
        label=r"TR-BDF2, $\tilde\gamma = 2 - \sqrt{2}$",
    )
    axes.set_ylim(0, 1.03)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def _order(table, scheme):
    """Observed order between the two smallest time steps."""
    step, error = table["time_step"], table[scheme]
    smallest, next_smallest = np.argsort(step)[:2]
    return np.log(error[next_smallest] / error[smallest]) / np.log(
        step[next_smallest] / step[smallest]
    )


def _order_check(scheme, exact, paper):
    # At the smallest time step the next term of the error is below 1 % of the
    # first one; 0.1 separates the integers by far.
    order = _order(SPECTRUM.read("oscillator_order.csv"), scheme)
    return check(
        f"order on an oscillator, {scheme}",
        f"{order:.3f}",
        abs(order - exact) < 0.1,
        "within 0.1 of the exact order",
        paper=paper,
        exact=str(exact),
    )


def checks_figure_3():
    table = SPECTRUM.read()
    omega = table["omega_tilde"]
    rows = []

    # The distance to the limit falls like 1/omega_tilde, with a factor of order
    # 1: at the last frequency, 1e7, it is 1e-7 or less.
    for alpha in ALPHAS:
        rows.append(
            check(
                f"limit of the spectral radius, alpha = {alpha:g}",
                f"{table[hht(alpha)][-1]:.7f}",
                abs(table[hht(alpha)][-1] - limit(alpha)) < 1e-6,
                "within 1e-6 (deviation ~ 1/omega, omega = 1e7)",
                paper="(1-|a|)/(1+|a|)",
                exact=f"{limit(alpha):.7f}",
            )
        )
    deviation = np.abs(table["Crank-Nicolson"] - 1).max()
    rows.append(
        check(
            "Crank-Nicolson: max |radius - 1|",
            f"{deviation:.1e}",
            deviation < 1e-12,
            "< 1e-12, round-off",
            paper="0",
            exact="0",
        )
    )
    largest = max(values.max() for name, values in table.items() if name != "omega_tilde")
    rows.append(
        check(
            "largest spectral radius of all schemes, minus 1",
            f"{largest - 1:.1e}",
            largest <= 1 + 1e-12,
            "<= 1e-12, round-off",
            paper="<= 0",
            exact="0",
        )
    )
    low = omega <= 1
    margin = min((table[hht(a)] - table[hht(-a)])[low].min() for a in COLOURS)
    rows.append(
        check(
            "radius(alpha) - radius(-alpha), least for omega <= 1",
            f"{margin:.1e}",
            margin > 0,
            "> 0: a negative alpha damps more at low frequencies",
            paper="> 0",
        )
    )

    # gamma = 1/2 + |alpha| gives up the second order when alpha < 0, for which
    # it would have to be 1/2 + alpha.
    rows += [_order_check(hht(alpha), 2 if alpha > 0 else 1, "2") for alpha in ALPHAS]
    orders = [_order(SPECTRUM.read("oscillator_order.csv"), hht(a)) for a in ALPHAS if a < 0]
    rows.append(
        note(
            "order for alpha < 0, gamma = 1/2 + |alpha|",
            f"{min(orders):.2f} ... {max(orders):.2f}",
            "C (28) claims second order; it is first order",
            paper="2",
            exact="1",
        )
    )
    return rows


def checks_figure_4():
    table = SPECTRUM.read()
    omega, radius = table["omega_tilde"], table["TR-BDF2"]
    # L-stability: the stability function falls like 1/(omega dt), that is like
    # omega_tilde^(-1/2). The factor is 2 (1 + sqrt 2) = 4.83: 1.5e-3 at 1e7.
    far = omega >= 1e5
    slope = np.polyfit(np.log(omega[far]), np.log(radius[far]), 1)[0]
    factor = 2 * (1 + np.sqrt(2))
    return [
        check(
            "TR-BDF2: spectral radius at omega = 1e7",
            f"{radius[-1]:.6f}",
            abs(radius[-1] * np.sqrt(omega[-1]) / factor - 1) < 1e-3,
            "within 0.1 % of 2 (1 + sqrt 2)/sqrt(omega), which tends to 0",
            paper="0 (limit)",
            exact=f"{factor / np.sqrt(omega[-1]):.6f}",
        ),
        check(
            "TR-BDF2: slope of the radius for omega >= 1e5",
            f"{slope:.4f}",
            abs(slope + 0.5) < 1e-3,
            "within 1e-3 of -1/2: falls to 0, L-stable",
            exact="-1/2",
        ),
        _order_check("Crank-Nicolson", 2, "2"),
        _order_check("TR-BDF2", 2, "2"),
    ]


FIGURES = [
    Figure(
        "C-3",
        "spectral radii of HHT",
        "Spectral radius of the amplification matrix against the squared frequency. A negative "
        "alpha (dashed) damps more at low frequencies than its positive counterpart; both tend "
        "to the same limit (dotted).",
        [SPECTRUM],
        draw_figure_3,
        checks_figure_3,
    ),
    Figure(
        "C-4",
        "spectral radii of HHT and TR-BDF2",
        "As figure C-3, with TR-BDF2, whose spectral radius tends to zero.",
        [SPECTRUM],
        draw_figure_4,
        checks_figure_4,
    ),
]
