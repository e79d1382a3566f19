# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page about the step in which contact begins (doc/static/toy.html), in a real browser: its
numbers against another computation, with whole matrices and trials of contact, and bar_sd's."""

import html
import json

from common import *

PAGE = ROOT / "doc" / "static" / "toy.html"
BROWSER = shutil.which("chromium")

try:
    import numpy as np
except ImportError:
    np = None

# Values of the sliders, one of which changes from case to case.
CASES = [
    {"model": model, "method": method, "s": s, "step": step, "log_k": log_k, "cells": 12}
    for model in ("mass", "bar")
    for method in ("crank-nicolson", "midpoint", "tr-bdf2", "improved")
    for s, step, log_k in ((0, .1, 3), (.37, .1, 3), (.37, .05, 3), (.37, .05, 2), (1, .05, 2))
]
# Actions of a user, and the page after each of them.
QUESTIONS = """<script>
const answers = CASES.map(values => {
  for (const [id, value] of Object.entries(values))
    document.getElementById(id).value = value;
  document.getElementById("s").dispatchEvent(new Event("input", {bubbles: true}));
  const number = id => parseFloat(document.getElementById(id).dataset.value);
  return {computed: number("computed"), formula: number("formula"),
          rows: document.getElementById("numbers").textContent.split("\\n").slice(1)
            .map(row => row.split(",").map(Number)),
          curves: [...document.querySelectorAll("polyline")]
            .map(each => each.getAttribute("points"))};
});
answers.push(run({model: "bar", method: "crank-nicolson", step: .05, k: 100, cells: 20}, 0, 240));
const pre = document.createElement("pre");
pre.id = "answer_of_test";
pre.textContent = JSON.stringify(answers);
document.body.append(pre);
</script></body>"""


class Body:
    """Matrices and start; the first unknown is the point that can touch."""

    def __init__(self, model, cells):
        if model == "mass":
            self.M, self.K = np.eye(1), np.zeros((1, 1))
            self.u, self.v = np.zeros(1), -np.ones(1)
            return
        h = 1. / cells
        self.M, self.K = np.zeros((2, cells + 1, cells + 1))
        for cell in range(cells):
            nodes = slice(cell, cell + 2)
            self.M[nodes, nodes] += h / 6. * np.array([[2., 1.], [1., 2.]])
            self.K[nodes, nodes] += 1. / h * np.array([[1., -1.], [-1., 1.]])
        self.M, self.K = self.M[:-1, :-1], self.K[:-1, :-1]
        self.u, self.v = .5 - .5 * np.linspace(0., 1., cells + 1)[:-1], np.zeros(cells)

    def energy(self, u, v):
        return .5 * v @ self.M @ v + .5 * u @ self.K @ u


def with_contact(matrix, right, k, obstacle):
    """u and force of matrix u + contact = right, the point being pressed or not."""
    u = np.linalg.solve(matrix, right)
    if u[0] >= obstacle:
        return u, 0.
    matrix, right = matrix.copy(), right.copy()
    matrix[0, 0] += k
    right[0] += k * obstacle
    u = np.linalg.solve(matrix, right)
    return u, k * (obstacle - u[0])


def trapezoidal(body, u, v, a, dt, k, obstacle):
    inertia = 4. / dt**2 * body.M
    predictor = u + dt * v + dt**2 / 4. * a
    new, force = with_contact(inertia + body.K, inertia @ predictor, k, obstacle)
    a_new = 4. / dt**2 * (new - predictor)
    return new, v + dt / 2. * (a + a_new), a_new, force


def step_of(method, body, u, v, a, dt, k, obstacle):
    """One step: u, v, a and force at its end."""
    if method == "crank-nicolson":
        return trapezoidal(body, u, v, a, dt, k, obstacle)
    if method == "tr-bdf2":
        g = 2. - np.sqrt(2.)
        u_m, v_m, _, _ = trapezoidal(body, u, v, a, g * dt, k, obstacle)
        u_3, v_3 = ((new - (1. - g)**2 * old) / (g * (2. - g)) for new, old in ((u_m, u), (v_m, v)))
        b = (1. - g) / (2. - g) * dt
        inertia = body.M / b**2
        new, force = with_contact(inertia + body.K, inertia @ (u_3 + b * v_3), k, obstacle)
        v_new = (new - u_3) / b
        return new, v_new, (v_new - v_3) / b, force
    matrix = 2. / dt**2 * body.M + .5 * body.K
    right = 2. / dt**2 * body.M @ (u + dt * v) - .5 * body.K @ u
    if method == "midpoint":
        new, force = with_contact(matrix, right, k, obstacle)
    else:
        # Bisection for the force: more of it, and the point is further out, with less of the law's.
        x = obstacle - u[0]
        out = np.linalg.solve(matrix, np.eye(len(u))[0])
        free = np.linalg.solve(matrix, right)

        def law(force):
            y = obstacle - free[0] - force * out[0]
            if y == x:
                return k * max(x, 0.)
            return .5 * k * (max(y, 0.)**2 - max(x, 0.)**2) / (y - x)

        low, high = 0., law(0.)
        for _ in range(200):
            middle = .5 * (low + high)
            low, high = (middle, high) if law(middle) > middle else (low, middle)
        force, new = low, free + low * out
    return new, 2. * (new - u) / dt - v, a, force


def computed(model, method, s, step, log_k, cells):
    """Change of energy in the step in which contact begins, and the rows of the run."""
    body, k = Body(model, cells), 10. ** log_k
    begin = body.u, body.v, np.linalg.solve(body.M, -body.K @ body.u), 0.
    first = max(1, int(1. / step - .5 + .5))
    state = begin
    for _ in range(first):
        state = step_of(method, body, *state[:3], step, k, -np.inf)
    after = step_of(method, body, *state[:3], step, k, -np.inf)
    obstacle = (1. - s) * state[0][0] + s * after[0][0]
    rows, state = [], begin
    for n in range(int(round(3.5 / step)) + 1):
        if n:
            state = step_of(method, body, *state[:3], step, k, obstacle)
        energy = body.energy(*state[:2])
        gap = state[0][0] - obstacle
        rows.append((n * step, gap, state[3], energy, energy + .5 * k * min(gap, 0.)**2))
    return (rows[first + 1][4] - rows[first][4]) / rows[0][3], np.array(rows)


@unittest.skipIf(np is None, "NumPy is missing")
@unittest.skipIf(BROWSER is None, "there is no browser (Debian's chromium)")
class ToyPage(ProgramTest):
    def answers(self):
        questions = self.folder / "questions.html"
        questions.write_text(PAGE.read_text().replace(
            "</body>", QUESTIONS.replace("CASES", json.dumps(CASES))))
        result = subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
             "--no-first-run", "--disable-background-networking", "--disable-component-update",
             "--disable-sync", f"--user-data-dir={self.folder / 'browser'}",
             "--virtual-time-budget=5000", "--dump-dom", f"file://{questions}"],
            capture_output=True, text=True, timeout=120)
        mark = '<pre id="answer_of_test">'
        begin = result.stdout.index(mark) + len(mark)
        return json.loads(html.unescape(result.stdout[begin:result.stdout.index("</pre>", begin)]))

    def test_numbers_and_curves(self):
        *answers, bar = self.answers()
        self.assertEqual(len(answers), len(CASES))
        for case, answer in zip(CASES, answers):
            with self.subTest(**case):
                change, rows = computed(**case)
                found = np.array(answer["rows"])
                self.assertEqual(found.shape, rows.shape)
                self.assertGreater(max(rows[:, 2]), .1)
                self.assertLess(np.abs(found - rows).max(), 1e-9 * max(1., np.abs(rows).max()))
                self.assertAlmostEqual(answer["computed"], change, delta=1e-9)
                # The formula beside it holds to round-off, and is the one of one mass.
                if case["method"] == "tr-bdf2":
                    self.assertIsNone(answer["formula"])
                    continue
                self.assertAlmostEqual(answer["computed"], answer["formula"], delta=1e-11)
                s, kw = case["s"], 10. ** case["log_k"] * case["step"]**2 / 4.
                if (case["model"], case["method"]) == ("mass", "crank-nicolson"):
                    self.assertAlmostEqual(change, -4. * s * (1. - s) * kw / (1. + kw), delta=1e-11)
                elif case["method"] == "improved":
                    self.assertLess(np.ptp(rows[:, 4]), 1e-11)
                elif 0. < s < 1.:
                    self.assertLess(change, -1e-3)
        curves = [answer["curves"] for answer in answers]
        for one, other in zip(curves, curves[1:]):
            self.assertGreater(len(one), 3)
            self.assertNotEqual(one, other)
        # A run of the program: Crank-Nicolson, penalty of 1/(epsilon_0 h) = 100.
        ledger = self.run_program("bar_sd", ["Contact/Treatment=penalty", "Output/Fields every=0"])
        for column, name in ((1, "displacement_left"), (2, "contact_pressure_left"),
                             (3, "energy"), (4, "modified_energy")):
            difference = np.array(bar)[:, column] - np.array(ledger[name])
            self.assertLess(np.abs(difference).max(), 1e-9, msg=name)

    def test_needs_no_network(self):
        for word in ("http:", "https:", "src=", "import "):
            self.assertNotIn(word, PAGE.read_text())


if __name__ == "__main__":
    main()
