#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the pictures of the pages in this folder, from the formulas on them.

    doc/methods/drawings.py            # all
    doc/methods/drawings.py penalty    # those whose names begin like this

Contact treatments are shown by one mass against a wall: mass 1, speed 1, wall at g = 0, steps
of length 1 of the midpoint scheme (penalty: Crank-Nicolson). It touches after 2.3 steps.
"""

import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
BLUE, RED, GREEN, ORANGE, GREY, PINK = (
    "#0072B2", "#D55E00", "#009E73", "#E69F00", "#888888", "#CC79A7")

plt.rcParams.update({
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "svg.hashsalt": "ricochet", "axes.titlesize": 9, "legend.frameon": False,
    "lines.linewidth": 1.6, "figure.constrained_layout.use": True})

DRAWINGS = {}


def drawing(function):
    DRAWINGS[function.__name__.replace("_", "-")] = function
    return function


def save(figure, name):
    figure.savefig(FOLDER / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def root(function, low, high):
    """The zero of a rising function."""
    for _ in range(200):
        middle = .5 * (low + high)
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return .5 * (low + high)


# One mass against a wall ---------------------------------------------------------

START = 2.3


def fly(pressure, n_steps=8, step=1., predictor=None):
    """Midpoint steps of a mass; pressure(g_0, g_1) where contact is a law."""
    g, v, rate = START, -1., -1.
    gaps, energies = [g], [.5]
    for _ in range(n_steps):
        if predictor:
            new = predictor(g, v, rate, step)
        else:
            new = root(lambda x: 2 * (x - g - step * v) / step**2 - pressure(g, x), -9, 9)
        rate = (new - g) / step
        v = 2 * rate - v
        g = new
        gaps.append(g)
        energies.append(.5 * v * v)
    return np.array(gaps), np.array(energies)


def signorini(g, v, rate, step):
    return max(g + step * v, 0.)


def persistent(g, v, rate, step):
    candidate = g + .5 * step * rate <= 0
    return g + max(step * v, 0.) if candidate else g + step * v


def two_step(g, v, rate, step):
    # First pass: the mean gap is not negative; second: touching nodes stay in place.
    return g if .5 * (g + g + step * v) < 0 else g + step * v


def discrete(c, alpha):
    def pressure(old, new):
        a, b = max(-old, 0.), max(-new, 0.)
        if abs(new - old) < 1e-12:
            return .5 * c * alpha * a**(alpha - 1)
        return .5 * c * (b**alpha - a**alpha) / (old - new)
    return pressure


def show_mass(name, law, law_title, gaps, energies, stored=None, gap_label="gap $g$"):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(8.2, 2.5))
    law(left)
    left.set_xlabel(gap_label)
    left.set_ylabel("pressure $p$")
    left.set_title(law_title)
    times = np.arange(len(gaps))
    exact = np.linspace(0, len(gaps) - 1, 400)
    middle.axhspan(-.75, 0, color="#dddddd")
    middle.plot(exact, np.abs(START - exact), color="k", lw=1, label="exact")
    middle.plot(times, gaps, "o-", color=BLUE, ms=4, label="computed")
    middle.set_ylim(-.75, 3.6)
    middle.set_xlabel("steps")
    middle.set_ylabel("gap")
    middle.legend(loc="upper center")
    middle.set_title("one mass against a wall")
    right.axhline(1, color="k", lw=1)
    right.plot(times, energies / energies[0], "o-", color=BLUE, ms=4, label="kinetic")
    if stored is not None:
        right.plot(times, (energies + stored) / energies[0], "--", color=ORANGE,
                   label="with what is stored")
        right.legend(loc="center right")
    right.set_ylim(-.08, max(1.25, 1.1 * (energies / energies[0]).max()))
    right.set_xlabel("steps")
    right.set_ylabel("energy / energy at the start")
    right.set_title("its energy")
    save(figure, name)


def corner(axes):
    axes.plot([0, 0, 1], [1, 0, 0], color=BLUE, lw=2.5, solid_joinstyle="miter")
    axes.set_xlim(-.4, 1.1)
    axes.set_ylim(-.1, 1.1)
    axes.axvline(0, color=GREY, lw=.5)


def spring(c, alpha):
    def law(axes):
        g = np.linspace(-.4, 1.1, 300)
        axes.plot(g, .5 * c * alpha * np.maximum(-g, 0)**(alpha - 1), color=BLUE, lw=2.5)
        axes.axvline(0, color=GREY, lw=.5)
        axes.set_xlim(-.4, 1.1)
    return law


@drawing
def signorini_active_set():
    show_mass("signorini-active-set", corner, "at the end of the step", *fly(None, predictor=signorini))


@drawing
def signorini_multipliers():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.4, 2.6))
    corner(left)
    left.set_xlabel("gap $g$")
    left.set_ylabel(r"multiplier $\lambda$")
    left.set_title(r"$g \geq 0$, $\lambda \geq 0$, $\lambda g = 0$")
    g, m = np.meshgrid(np.linspace(-1, 1, 201), np.linspace(-1, 1, 201))
    residual = m - np.maximum(m - g, 0)
    right.contourf(g, m, m - g > 0, levels=[-.5, .5, 1.5], colors=["#eef4fa", "#fbeade"])
    right.contour(g, m, residual, levels=[0], colors=[BLUE], linewidths=2.5)
    right.text(-.9, .55, "active:\n$g = 0$", color=RED)
    right.text(.1, -.75, r"inactive: $\lambda = 0$", color=BLUE)
    right.set_xlabel("gap $r g$")
    right.set_ylabel(r"multiplier $\lambda$")
    right.set_title(r"zeros of $\lambda - [\lambda - r g]_+$")
    save(figure, "signorini-multipliers")


@drawing
def persistent_contact():
    def law(axes):
        axes.plot([0, 0, 1], [1, 0, 0], color=BLUE, lw=2.5, solid_joinstyle="miter")
        axes.set_xlim(-.4, 1.1)
        axes.set_ylim(-.1, 1.1)
    show_mass("persistent-contact", law, "where it is expected to touch",
              *fly(None, predictor=persistent), gap_label=r"change of the gap $\Delta g$")


@drawing
def ayyad_barboteu_two_step():
    def law(axes):
        axes.plot([0, 0, 1], [1, 0, 0], color=GREY, lw=2, label="first: mean gap")
        axes.plot([0, 0], [0, 1], color=BLUE, lw=3, label=r"then: $\Delta g = 0$")
        axes.set_xlim(-.4, 1.1)
        axes.set_ylim(-.1, 1.1)
        axes.legend(loc="upper right")
    show_mass("ayyad-barboteu-two-step", law, "two passes", *fly(None, predictor=two_step),
              gap_label="what each pass closes")


def compliance(name, c, alpha, pressure, title):
    gaps, energies = fly(pressure)
    show_mass(name, spring(c, alpha), title, gaps, energies,
              .5 * c * np.maximum(-gaps, 0)**alpha)


@drawing
def standard_normal_compliance():
    compliance("standard-normal-compliance", 6., 2., lambda old, new: 6. * max(-new, 0.),
               "a spring, at the end of the step")


@drawing
def standard_normal_compliance_at_midpoint():
    compliance("standard-normal-compliance-at-midpoint", 6., 2.,
               lambda old, new: 6. * max(-.5 * (old + new), 0.), "a spring, at the mean gap")


@drawing
def improved_normal_compliance():
    figure_law = discrete(6., 2.)
    gaps, energies = fly(figure_law)

    def law(axes):
        g = np.linspace(-.5, .6, 300)
        axes.plot(g, 3. * np.maximum(-g, 0)**2, color=ORANGE, lw=2, label="potential")
        ends = np.array([.3, -.4])
        axes.plot(ends, 3. * np.maximum(-ends, 0)**2, "o-", color=BLUE, label="$p$ = minus its slope")
        axes.set_xlim(-.55, .65)
        axes.legend(loc="upper right")
    show_mass("improved-normal-compliance", law, "quotient of differences", gaps, energies,
              3. * np.maximum(-gaps, 0)**2)


@drawing
def hauret_le_tallec():
    figure, axes = plt.subplots(1, 2, figsize=(6.4, 2.4), sharey=True)
    for panel, title, points in zip(
            axes, ("in the nodes (improved normal compliance)", "in quadrature points"),
            ([0, 1, 2, 3], [c + s for c in range(3) for s in (.2113, .7887)])):
        x = np.array([0, 1, 2, 3])
        y = np.array([.5, -.3, -.45, .25])
        panel.axhspan(-.8, 0, color="#dddddd")
        panel.plot(x, y, color="k")
        panel.plot(points, np.interp(points, x, y), "o", color=BLUE)
        for point in points:
            depth = np.interp(point, x, y)
            if depth < 0:
                panel.annotate("", (point, depth), (point, depth - .3),
                               arrowprops={"arrowstyle": "->", "color": RED})
        panel.set_title(title)
        panel.set_xticks([])
        panel.set_ylim(-.85, .7)
    axes[0].set_ylabel("gap of the surface")
    save(figure, "hauret-le-tallec")


@drawing
def penalty():
    """With Crank-Nicolson, which is the scheme of paper C."""
    c, g, v, a = 3., START, -1., 0.
    gaps, energies = [g], [.5]
    for _ in range(8):
        new = root(lambda x: x - g - v - .25 * (a + c * max(-x, 0.)), -9, 9)
        new_a = c * max(-new, 0.)
        v += .5 * (a + new_a)
        g, a = new, new_a
        gaps.append(g)
        energies.append(.5 * v * v)
    gaps = np.array(gaps)
    show_mass("penalty", spring(c, 2.), "a spring", gaps, np.array(energies),
              .5 * c * np.maximum(-gaps, 0)**2)


@drawing
def nitsche():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 2.6))
    g = np.linspace(-.5, .8, 400)
    for stress, colour in ((0., GREY), (.5, BLUE), (1., RED)):
        q = np.maximum(stress - 3 * g, 0)
        left.plot(g, q, color=colour, label=rf"$p(u_h) = {stress:g}$")
        left.plot([0], [stress], "o", color=colour)
        right.plot(g, (q**2 - stress**2) / 6, color=colour)
        right.plot([0], [0], "o", color="k")
    left.axvline(0, color=GREY, lw=.5)
    left.set_xlabel("gap $g$")
    left.set_ylabel(r"contact pressure $[p(u_h) - \gamma g]_+$")
    left.legend()
    left.set_title("no penetration is needed for a pressure")
    right.set_xlabel("gap $g$")
    right.set_ylabel(r"potential $([q]_+^2 - p^2)/(2\gamma)$")
    right.set_title("zero where the condition is fulfilled")
    save(figure, "nitsche")


@drawing
def nitsche_hybrid():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 2.6), sharey=True)
    new = np.linspace(-1.5, 1.5, 400)
    plus = lambda x: np.maximum(x, 0)
    for axes, old in ((left, .8), (right, -.8)):
        mean, average = plus(.5 * (old + new)), .5 * (plus(old) + plus(new))
        used = mean if old > 0 else average
        axes.plot(new, mean, color=GREY, lw=1, ls="--", label="positive part of the mean")
        axes.plot(new, average, color=GREY, lw=1, ls=":", label="mean of the positive parts")
        axes.plot(new, used, color=BLUE, lw=2.5, label="hybrid")
        axes.set_xlabel("$q_1$ at the end of the step")
        axes.set_title(f"$q_0 = {old:g}$: begins " + ("in contact" if old > 0 else "without"))
    left.set_ylabel("contact pressure of the step")
    left.legend()
    save(figure, "nitsche-hybrid")


@drawing
def proximal_augmented_lagrangian():
    figure, axes = plt.subplots(figsize=(4.4, 2.8))
    g = np.linspace(-.5, .8, 400)
    for multiplier, colour in ((0., GREY), (.5, BLUE), (1., RED)):
        axes.plot(g, np.maximum(multiplier - 3 * g, 0), color=colour,
                  label=rf"$\lambda = {multiplier:g}$")
        axes.plot([0], [multiplier], "o", color=colour)
    axes.set_xlabel("gap $g$")
    axes.set_ylabel(r"contact pressure $[\lambda - \gamma g]_+$")
    axes.legend(title="at the dots it is the multiplier")
    save(figure, "proximal-augmented-lagrangian")


@drawing
def friction_exact():
    figure, axes = plt.subplots(figsize=(3.6, 2.6))
    axes.plot([-1, 0, 0, 1], [1, 1, -1, -1], color=BLUE, lw=2.5, solid_joinstyle="miter")
    friction_axes(axes)
    save(figure, "friction-exact")


def friction_axes(axes):
    axes.axhline(0, color=GREY, lw=.5)
    axes.axvline(0, color=GREY, lw=.5)
    axes.set_xlabel(r"slip rate $v_\tau$")
    axes.set_ylabel(r"traction $t$")
    axes.set_yticks([-1, 0, 1])
    axes.set_yticklabels([r"$-\mu p$", "0", r"$\mu p$"])
    axes.set_xticks([])


@drawing
def friction_regularised():
    figure, axes = plt.subplots(figsize=(3.6, 2.6))
    v = np.linspace(-1, 1, 401)
    axes.plot(v, np.clip(-5 * v, -1, 1), color=BLUE, lw=2.5)
    axes.annotate(r"slope $-c_\tau$", (-.1, .5), (-.85, .2), arrowprops={"arrowstyle": "->"})
    friction_axes(axes)
    save(figure, "friction-regularised")


@drawing
def slip_rate_friction():
    figure, axes = plt.subplots(figsize=(3.6, 2.6))
    v = np.linspace(-1, 1, 801)
    limit = 1 + 2 * np.exp(-8 * np.abs(v))
    axes.plot(v, -np.sign(v) * limit, color=BLUE, lw=2.5)
    friction_axes(axes)
    axes.set_yticks([-3, -1, 0, 1, 3])
    axes.set_yticklabels([r"$-a p$", r"$-b p$", "0", r"$b p$", r"$a p$"])
    save(figure, "slip-rate-friction")


# Time schemes --------------------------------------------------------------------


def newmark_matrix(w, alpha_m, alpha_f, beta, gamma):
    """Amplification of (u, dt u', dt^2 u'') for (omega dt)^2 = w."""
    columns = []
    for state in np.eye(3):
        u, v, a = state
        origin = u + v + (.5 - beta) * a
        new_a = (-((1 - alpha_f) * w * origin + alpha_f * w * u + alpha_m * a)
                 / (1 - alpha_m + (1 - alpha_f) * w * beta))
        columns.append([origin + beta * new_a, v + (1 - gamma) * a + gamma * new_a, new_a])
    return np.array(columns).T


def hht_matrix(w, alpha):
    return newmark_matrix(w, 0., alpha, .25 * (1 + abs(alpha))**2, .5 + abs(alpha))


def generalised_alpha_matrix(w, radius):
    alpha_m, alpha_f = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    return newmark_matrix(w, alpha_m, alpha_f, .25 * (1 - alpha_m + alpha_f)**2,
                          .5 - alpha_m + alpha_f)


def tr_bdf2_matrix(w, part=2 - 2**.5):
    scale = np.diag([1, part, part**2])
    middle = np.linalg.inv(scale) @ hht_matrix(part**2 * w, 0.) @ scale
    a_m, a_0 = 1 / (part * (2 - part)), (1 - part)**2 / (part * (2 - part))
    rate = (1 - part) / (2 - part)
    columns = []
    for state in np.eye(3):
        m = middle @ state
        v_part = a_m * m[1] - a_0 * state[1]
        origin = a_m * m[0] - a_0 * state[0] + rate * v_part
        new_a = -w * origin / (1 + rate**2 * w)
        columns.append([origin + rate**2 * new_a, v_part + rate * new_a, new_a])
    return np.array(columns).T


def bdf2_matrix(w):
    """A step of length 1 on the states (u, v) at the ends of the last two steps."""
    matrix = np.zeros((4, 4))
    for column, (u, v, u_before, v_before) in enumerate(np.eye(4)):
        v_part = 4 / 3 * v - v_before / 3
        origin = 4 / 3 * u - u_before / 3 + 2 / 3 * v_part
        a = -w * origin / (1 + 4 / 9 * w)
        matrix[:, column] = origin + 4 / 9 * a, v_part + 2 / 3 * a, u, v
    return matrix


SCHEMES = {
    "crank-nicolson": [("Crank-Nicolson", lambda w: hht_matrix(w, 0.), BLUE)],
    "hht": [(rf"HHT, $\alpha = {a:g}$", lambda w, a=a: hht_matrix(w, a), c)
            for a, c in ((.05, BLUE), (-.02, RED), (-.05, ORANGE), (.1, GREEN))],
    "generalised-alpha": [
        (rf"generalised-$\alpha$, $\rho = {r:g}$",
         lambda w, r=r: generalised_alpha_matrix(w, r), c)
        for r, c in ((.8, BLUE), (.5, RED), (0., GREEN))],
    "newmark": [(rf"Newmark, $\beta = {b:g}$, $\gamma = {g:g}$",
                 lambda w, b=b, g=g: newmark_matrix(w, 0., 0., b, g), c)
                for b, g, c in ((.3025, .6, BLUE), (.25, .5, GREY), (.5625, 1., GREEN))],
    "bdf2": [("BDF2", bdf2_matrix, BLUE), ("TR-BDF2", tr_bdf2_matrix, GREY)],
    "tr-bdf2": [("TR-BDF2", tr_bdf2_matrix, BLUE),
                (r"HHT, $\alpha = 0.05$", lambda w: hht_matrix(w, .05), GREY)],
}


def show_scheme(name):
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 2.6))
    w = np.logspace(-2, 5, 300)
    for label, matrix, colour in SCHEMES[name]:
        left.semilogx(w, [abs(np.linalg.eigvals(matrix(x))).max() for x in w], color=colour,
                      label=label)
    left.set_ylim(0, 1.05)
    left.set_xlabel(r"$(\omega\Delta t)^2$")
    left.set_ylabel("spectral radius")
    left.legend()
    left.set_title("what a step leaves of a vibration")
    label, matrix, colour = SCHEMES[name][0]
    for i, (frequency, shade) in enumerate(((.2, colour), (12., RED))):
        # From rest; of two steps, with the exact state a step before.
        speed = frequency**.5
        state, values = np.array(
            [1., 0., -frequency] if len(matrix(frequency)) == 3
            else [1., 0., np.cos(speed), speed * np.sin(speed)]), [1.]
        for _ in range(60):
            state = matrix(frequency) @ state
            values.append(state[0])
        right.plot(values, ".-", ms=3, lw=.8, color=shade,
                   label=rf"$(\omega\Delta t)^2 = {frequency:g}$")
    right.set_xlabel("steps")
    right.legend(loc="upper right")
    right.set_ylim(-1.3, 1.9)
    right.set_title(f"free vibration, {label}")
    save(figure, name)


for _name in SCHEMES:
    DRAWINGS[_name] = lambda name=_name: show_scheme(name)


@drawing
def static():
    """A nonlinear spring that is pulled in load steps, and a mass that falls onto a spring."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 2.6))
    force, stored = lambda u: u + 2. * u**3, lambda u: .5 * u**2 + .5 * u**4
    u = np.linspace(0, 1, 200)
    left.plot(u, force(u), color=GREY, label="equilibria")
    for n, colour in ((2, RED), (4, BLUE)):
        ends = np.linspace(0, 1, n + 1)
        path = np.sum(.5 * np.diff(ends) * (force(ends[1:]) + force(ends[:-1]))) - stored(1.)
        left.plot(ends, force(ends), "o-", ms=3, lw=1, color=colour,
                  label=rf"{n} steps, path {path:.2f}")
    left.set_xlabel("displacement")
    left.set_ylabel("load")
    left.legend()
    left.set_title("works by the trapezoidal rule")
    # Contact is a spring of stiffness 100 below 0; mass and weight are 1.
    x, c, last, imbalances = 1., 10., 0., []
    for _ in range(30):
        new = x - 1. / c
        if new < 0.:
            new = (c * x - 1.) / (c + 100.)
        imbalance, move, x = c * abs(new - x), abs(new - x), new
        imbalances.append(imbalance)
        if imbalance < 1e-11:
            break
        c *= np.clip(min(imbalance / last if last else 1., move / .25), .01, .5)
        last = imbalance
    right.semilogy(imbalances, "o-", ms=3, lw=1, color=BLUE)
    right.set_xlabel("$k$")
    right.set_title("imbalance of a mass that falls onto a spring")
    save(figure, "static")


@drawing
def midpoint():
    """A stiff pendulum: a mass on a nonlinear spring in 2D."""
    figure, axes = plt.subplots(figsize=(5.4, 2.7))
    stored = lambda x: 25. * (x @ x - 1)**2
    results = {}
    for name in ("discrete derivative", "force of the mean"):
        x, v, dt = np.array([1.02, 0.]), np.array([0., 3.]), .1
        energies = []
        for _ in range(100):
            energies.append(.5 * v @ v + stored(x))
            new = x + dt * v
            for _ in range(200):
                mean = .5 * (x + new)
                if name == "discrete derivative":
                    factor = 50. * ((x @ x - 1) + (new @ new - 1))
                else:
                    factor = 100. * (mean @ mean - 1)
                # Fixed point on new, with the stiff factor implicit.
                new = x + (dt * v - .5 * dt**2 * factor * x * 1.) / (1 + .25 * dt**2 * factor)
            v = 2 * (new - x) / dt - v
            x = new
        results[name] = np.array(energies)
    for (name, energies), colour in zip(results.items(), (BLUE, RED)):
        axes.plot(energies / energies[0], color=colour, label=name)
    axes.set_xlabel("steps")
    axes.set_ylabel("energy / energy at the start")
    axes.set_ylim(.995, 1.045)
    axes.legend(loc="upper right", ncol=2)
    axes.set_title("a mass on a stiff rubber band that turns")
    save(figure, "midpoint")


@drawing
def arkode():
    """Step doubling with a Runge-Kutta method of fourth order: how long are its steps?"""
    stiffness = 400.

    def rate(y):
        return np.array([y[1], stiffness * max(-y[0], 0.)])

    def runge_kutta(y, h):
        k1 = rate(y)
        k2 = rate(y + .5 * h * k1)
        k3 = rate(y + .5 * h * k2)
        k4 = rate(y + h * k3)
        return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    y, t, h = np.array([.5, -1.]), 0., .05
    times, steps, gaps = [], [], []
    while t < 1.2:
        once = runge_kutta(y, h)
        twice = runge_kutta(runge_kutta(y, .5 * h), .5 * h)
        error = abs(once - twice).max() / 1e-7
        if error < 1:
            times.append(t)
            steps.append(h)
            gaps.append(y[0])
            t, y = t + h, twice
        h = min(.05, h * min(2., max(.2, .9 * (1 / max(error, 1e-12))**.2)))
    figure, (above, below) = plt.subplots(2, 1, figsize=(5.4, 3.2), sharex=True)
    above.plot(times, gaps, ".-", color=BLUE, ms=3, lw=1)
    above.axhline(0, color=GREY, lw=.5)
    above.set_ylabel("gap")
    below.semilogy(times, steps, color=RED)
    below.set_ylabel("length of its steps")
    below.set_xlabel("time")
    save(figure, "arkode")


# Materials -----------------------------------------------------------------------

LAMBDA, MU = 1.5, 1.


def energies_of(law, stretch):
    """W for the stretch along one direction, the others held."""
    i1, i2, i3 = stretch**2 + 2, 2 * stretch**2 + 1, stretch**2
    if law == "linear elastic":
        return (.5 * LAMBDA + MU) * (stretch - 1)**2
    if law == "Saint Venant-Kirchhoff":
        return (.5 * LAMBDA + MU) * (.5 * (stretch**2 - 1))**2
    if law == "neo-Hookean":
        return .5 * MU * (i1 - 3) - MU * np.log(stretch) + .5 * LAMBDA * np.log(stretch)**2
    c1, c2 = .4 * MU, .1 * MU
    if law == "Mooney-Rivlin":
        return (c1 * (i1 * i3**(-1 / 3) - 3) + c2 * (i2 * i3**(-2 / 3) - 3)
                + .5 * (LAMBDA + 2 / 3 * MU) * (stretch - 1)**2)
    if law == "Yeoh":
        x = i1 * i3**(-1 / 3) - 3
        return (.5 * MU * x - .02 * MU * x**2 + .005 * MU * x**3
                + .5 * (LAMBDA + 2 / 3 * MU) * (stretch - 1)**2)
    d = .25 * LAMBDA - c2
    return c1 * (i1 - 3) + c2 * (i2 - 3) + d * (i3 - 1) - (c1 + 2 * c2 + d) * np.log(i3)


LAWS = ("linear elastic", "Ciarlet-Geymonat", "Saint Venant-Kirchhoff", "neo-Hookean",
        "Mooney-Rivlin", "Yeoh")


def show_law(which):
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 2.7))
    stretch = np.linspace(.08, 1.8, 600)
    for law in LAWS:
        own = law == which
        colour, width, order = (BLUE, 2.6, 3) if own else (GREY, 1., 1)
        energy = energies_of(law, stretch)
        left.plot(stretch, energy, color=colour, lw=width, zorder=order)
        right.plot(stretch, np.gradient(energy, stretch), color=colour, lw=width, zorder=order,
                   label=law if own else None)
    left.set_ylim(0, 3)
    right.set_ylim(-6, 6)
    for axes, label in ((left, "energy $W$"), (right, "stress $F S$")):
        axes.axvline(1, color=GREY, lw=.5)
        axes.set_xlabel("stretch in one direction")
        axes.set_ylabel(label)
    right.legend(loc="lower right")
    left.set_title("moduli that agree at small strains")
    right.set_title("grey: the other laws")
    save(figure, which.lower().replace(" ", "-"))


for _law in LAWS:
    DRAWINGS[_law.lower().replace(" ", "-")] = lambda law=_law: show_law(law)


@drawing
def viscosity():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 2.6))
    t = np.linspace(0, 2 * np.pi, 300)
    strain, rate = .1 * np.sin(t), .1 * np.cos(t)
    for eta, colour in ((0., GREY), (.2, BLUE), (.5, RED)):
        left.plot(strain, strain + eta * rate, color=colour, label=rf"$\eta = {eta:g}$")
    left.set_xlabel("strain")
    left.set_ylabel("stress")
    left.legend()
    left.set_title("a cycle: the area is heat")
    trace = np.linspace(2, 5, 200)
    right.plot(trace, np.ones_like(trace), color=GREEN, label="Curnier")
    right.plot(trace, .5 * np.maximum(trace - 3, 0), color=BLUE, label="Pioletti")
    right.set_xlabel(r"tr $C$")
    right.set_ylabel(r"power / $(\eta |\dot C|^2)$")
    right.axvline(3, color=GREY, lw=.5)
    right.legend()
    right.set_title("Pioletti's is clipped at tr $C$ = 3")
    save(figure, "viscosity")


# Mass ----------------------------------------------------------------------------


@drawing
def mass_redistribution():
    n = 20
    h, x = 1. / n, np.linspace(0, 1, n + 1)
    mass = np.zeros((n + 1, n + 1))
    for cell in range(n):
        mass[cell:cell + 2, cell:cell + 2] += h / 6 * np.array([[2, 1], [1, 2]])
    pattern = mass != 0
    pattern[0, :] = pattern[:, 0] = False
    kept = np.where(pattern, mass, 0)
    one = np.ones(n + 1)
    moments = [np.outer(one, one), .5 * (np.outer(x, one) + np.outer(one, x)), np.outer(x, x)]
    rows = [np.where(pattern, m, 0) for m in moments]
    system = np.array([[(a * b).sum() for b in moments] for a in rows])
    missing = np.array([((mass - kept) * m).sum() for m in moments])
    factors = np.linalg.solve(system, missing)
    new = kept + sum(f * r for f, r in zip(factors, rows))
    figure, axes = plt.subplots(figsize=(5.4, 2.7))
    axes.plot(x, mass.sum(1), "x", color="k", label="consistent")
    axes.plot(x, new.sum(1), "o", color=BLUE, mfc="none", label="redistributed")
    axes.set_xlabel("place of the node; contact at 0")
    axes.set_ylabel("mass of the node (row sum)")
    axes.set_ylim(-.003, .075)
    axes.legend()
    axes.set_title(f"a bar of mass 1 with {n} elements")
    save(figure, "mass-redistribution")


# Geometry ------------------------------------------------------------------------


def sketch(width, height):
    figure, axes = plt.subplots(figsize=(width, height))
    axes.set_aspect("equal")
    axes.axis("off")
    return figure, axes


def arrow(axes, start, end, colour="k", label="", at=(0, 0), style="->"):
    axes.annotate("", end, start, arrowprops={
        "arrowstyle": style, "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0})
    if label:
        axes.text(*(.5 * (np.array(start) + end) + at), label, color=colour)


@drawing
def plane():
    figure, axes = sketch(4.2, 2.4)
    axes.fill_between([-2, 2], -.5, 0, color="#dddddd")
    angle = np.linspace(0, 2 * np.pi, 200)
    axes.plot(np.cos(angle), 1.35 + np.sin(angle), color="k")
    point = np.array([np.cos(-1.1), 1.35 + np.sin(-1.1)])
    axes.plot(*point, "o", color=BLUE)
    arrow(axes, (point[0], 0), point, BLUE, "$g$", (.06, -.1), "<->")
    arrow(axes, (-1.4, 0), (-1.4, .6), RED, r"$\nu$", (.08, 0))
    axes.text(-1.9, -.32, r"foundation: $g = g_0 + \nu\cdot u$")
    axes.set_ylim(-.5, 2.4)
    save(figure, "plane")


@drawing
def rigid_obstacles():
    figure, axes = sketch(4.4, 2.8)
    angle = np.linspace(0, np.pi, 200)
    axes.fill(np.cos(angle), np.sin(angle), color="#dddddd")
    begin, end = np.array([-.75, 1.05]), np.array([.55, .95])
    for point, label, shift in ((begin, "$x_0$", (-.2, .06)), (end, "$x_1$", (.06, .06))):
        axes.plot([0, point[0]], [0, point[1]], color=GREY, lw=.8)
        axes.plot(*point, "o", color=BLUE)
        axes.text(*(point + shift), label)
    arrow(axes, begin, end, BLUE)
    direction = (begin + end) / (np.linalg.norm(begin) + np.linalg.norm(end))
    middle = .5 * (begin + end)
    arrow(axes, middle, middle + .5 * direction, RED, "$D$", (.05, .05))
    axes.plot(0, 0, "k+")
    axes.text(.05, -.12, "$c$")
    axes.text(-.35, .3, r"$D = \dfrac{r_0 + r_1}{|r_0| + |r_1|}$")
    axes.set_ylim(-.2, 1.75)
    save(figure, "rigid-obstacles")


@drawing
def body_against_body():
    figure, axes = sketch(4.8, 2.6)
    a, b, y = np.array([2., .1]), np.array([0., .3]), np.array([.85, .85])
    axes.fill([0, 2, 2.6, -.6], [.3, .1, -.6, -.6], color="#eeeeee")
    axes.plot([-.6, 0, 2, 2.6], [-.1, .3, .1, -.5], color="k")
    axes.plot([.2, y[0], 1.6], [1.25, y[1], 1.3], color="k")
    foot = b + (a - b) * ((y - b) @ (a - b)) / ((a - b) @ (a - b))
    arrow(axes, foot, y, BLUE, "$g$", (.06, -.08), "<->")
    normal = (y - foot) / np.linalg.norm(y - foot)
    part = np.linalg.norm(foot - b) / np.linalg.norm(a - b)
    for point, size in ((y, .5), (a, -.8 * part), (b, -.8 * (1 - part))):
        arrow(axes, point, point + size * normal, RED)
    for point, label, shift in ((y, "$y$ (slave)", (.1, .02)), (a, "$a$", (.08, .08)),
                                (b, "$b$", (-.18, .1))):
        axes.plot(*point, "o", color="k")
        axes.text(*(point + shift), label)
    axes.text(-.55, 1.15, "red: $p D$ on the\nthree points", color=RED)
    axes.set_ylim(-.6, 1.6)
    save(figure, "body-against-body")


def two_surfaces(cuts):
    figure, axes = sketch(5.2, 1.9)
    lower, upper = np.linspace(0, 5, 6), np.linspace(.15, 4.85, 8)
    axes.plot(lower, 0 * lower, "o-", color="k")
    axes.plot(upper, 0 * upper + .5, "s-", color=BLUE)
    axes.text(5.15, .45, "slave", color=BLUE)
    axes.text(5.15, -.05, "master")
    for x in lower:
        if cuts and upper[0] < x < upper[-1]:
            axes.plot([x, x], [0, .5], color=GREY, lw=.8, ls="--")
    axes.set_xlim(-.1, 6.1)
    axes.set_ylim(-.35, 1.35)
    return figure, axes, lower, upper


@drawing
def mortar():
    figure, axes, _, upper = two_surfaces(True)
    axes.fill_between([upper[2], upper[3], upper[4]], [.5, .5, .5], [.5, 1.15, .5],
                      color=ORANGE, alpha=.4)
    axes.text(upper[3] + .1, 1.1, r"$\psi_j$: mean gap around node $j$", color=RED)
    save(figure, "mortar")


@drawing
def cut_faces():
    figure, axes, lower, upper = two_surfaces(True)
    ends = np.unique(np.concatenate([upper, lower[(lower > upper[0]) & (lower < upper[-1])]]))
    for left, right in zip(ends[:-1], ends[1:]):
        for s in (.2113, .7887):
            axes.plot(left + s * (right - left), .5, "x", color=RED, ms=4)
    axes.text(0, .8, "quadrature points between two cuts", color=RED)
    save(figure, "cut-faces")


@drawing
def self_contact():
    figure, axes = sketch(4.6, 2.4)
    s = np.linspace(-1.25, 1.25, 200)
    outer = np.array([2 * np.cos(s) - .6, .9 * np.sin(s) * (1 - .45 * np.abs(s))])
    angle = np.linspace(.35, 2 * np.pi - .35, 60)
    x, y = 1.6 * np.cos(angle), .75 * np.sin(angle) * (1 - .5 * np.cos(angle)**2)
    for scale in (1., .78):
        axes.plot(-scale * x, scale * y + (0 if scale == 1 else 0), color="k")
    n = 22
    axes.plot(-.78 * x[n], .78 * y[n], "o", color=BLUE)
    m = len(x) - 1 - n
    arrow(axes, (-.78 * x[n], .78 * y[n]), (-.78 * x[m], .78 * y[m]), BLUE, "$g$", (.06, 0), "<->")
    axes.text(-1.7, 1.0, "each node before the facets of the same surface\nthat face it, but for its own",
              color=BLUE)
    axes.set_ylim(-.85, 1.5)
    save(figure, "self-contact")


def main():
    wanted = sys.argv[1:]
    for name, draw in DRAWINGS.items():
        if not wanted or any(name.startswith(start) for start in wanted):
            draw()


if __name__ == "__main__":
    main()
