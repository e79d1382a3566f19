# SPDX-License-Identifier: LGPL-2.1-or-later
"""The notebooks of the documentation: their cells run one after the other, without
Jupyter, and confirm the text between them."""

import contextlib
import io
import json
import re
from unittest import mock

from common import *

try:
    import matplotlib.pyplot  # and with it matplotlib
    import numpy
except ImportError:
    numpy = None


def numbers_after(words, printed):
    """The numbers that follow these words wherever they were printed."""
    found = re.findall(re.escape(words) + r"\s*(-?[\d.]+(?:e[-+]?\d+)?)", printed)
    return [float(number) for number in found]


@unittest.skipIf(numpy is None, "NumPy or matplotlib (Debian's python3-matplotlib) is missing")
class Notebooks(ProgramTest):

    def run_cells(self, name):
        """Run all cells as one script. Returns the names that it has defined, what it
        has printed, and its figures."""
        notebook = json.loads((ROOT / "doc" / "notebooks" / f"{name}.ipynb").read_text())
        names, printed, figures = {"__name__": name}, io.StringIO(), []
        plots = matplotlib.pyplot
        self.addCleanup(sys.path.__setitem__, slice(None), list(sys.path))
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(plots.switch_backend, matplotlib.get_backend())
        plots.switch_backend("Agg")
        # Notebooks find the source tree from where they are, the programs by this
        # variable, and write into a temporary folder.
        os.chdir(ROOT / "doc" / "notebooks")
        with mock.patch.dict(os.environ, RICOCHET_PROGRAMS=program_path("")), \
                mock.patch.object(tempfile, "tempdir", str(self.folder)), \
                matplotlib.rc_context(), contextlib.redirect_stdout(printed):
            for number, cell in enumerate(notebook["cells"]):
                if cell["cell_type"] != "code":
                    continue
                source = "".join(cell["source"])
                exec(compile(source, f"{name}.ipynb, cell {number}", "exec"), names)
                # A cell begins with a new figure.
                for figure in map(plots.figure, plots.get_fignums()):
                    figure.canvas.draw()
                    figures.append(figure)
                plots.close("all")
        self.assertTrue(str(names["folder"]).startswith(str(self.folder)))
        return names, printed.getvalue(), figures

    def test_outside_of_the_source_tree(self):
        """They end with a sentence."""
        for path in sorted((ROOT / "doc" / "notebooks").glob("*.ipynb")):
            cells = json.loads(path.read_text())["cells"]
            first = next("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
            self.addCleanup(os.chdir, os.getcwd())
            os.chdir(self.folder)
            with self.assertRaisesRegex(SystemExit, "needs the source tree of Ricochet"):
                exec(first, {"__name__": path.stem})

    def test_energy_of_an_impact(self):
        names, printed, figures = self.run_cells("energy_of_an_impact")
        self.assertEqual(len(figures), 3)
        # Signorini and standard normal compliance lose half a per cent, the others
        # nothing.
        lost = dict(zip(names["treatments"], numbers_after("lost", printed)))
        for treatment in ("Signorini active set", "standard normal compliance"):
            self.assertAlmostEqual(lost[treatment], .005, delta=.0015)
        for treatment in ("improved normal compliance", "persistent contact"):
            self.assertEqual(lost[treatment], 0.)
        # Up to one per cent while it touches; nothing at any time.
        energy = {name: run.table["energy"] / run.table["energy"][0]
                  for name, run in names["runs"].items()}
        self.assertAlmostEqual(1. - min(energy["improved normal compliance"]), .01,
                               delta=.003)
        self.assertLess(largest(energy["persistent contact"] - 1.), 1e-10)
        # All four balances close to round-off; never all of it as kinetic energy.
        residuals = numbers_after("residual of the balance", printed)
        self.assertEqual(len(residuals), 4)
        self.assertLess(max(residuals), 1e-11)
        self.assertLess(max(numbers_after("kinetic at the end", printed)), .9995)
        # Ten positions: most is lost in the middle of the step.
        lost = names["lost"]
        self.assertEqual(len(lost), 10)
        self.assertLess(max(lost[0], lost[-1]), .6 * max(lost[3:7]))

    def test_friction_stick_slip_and_dissipation(self):
        names, printed, figures = self.run_cells("friction_stick_slip_and_dissipation")
        self.assertEqual(len(figures), 3)
        # Blocks stop where a rigid one does.
        ways = numbers_after("has slid", printed)
        rigid = numbers_after("a rigid block", printed)
        self.assertEqual(len(ways), 3)
        for way, exact in zip(ways, rigid):
            self.assertAlmostEqual(way / exact, 1., delta=.03)
        # The work of the belt is m v^2 = 5 J, half of it is heat, whatever the coefficient.
        [axes] = figures[1].axes
        ends = [line.get_ydata()[-1] for line in axes.lines]
        self.assertEqual(len(ends), 6)
        for work, heat in zip(ends[::2], ends[1::2]):
            self.assertAlmostEqual(work, 5., delta=.05)
            self.assertAlmostEqual(heat, 2.5, delta=.03)
        # Dissipation in the ring grows with friction, but less and less so.
        taken = {mu: part for mu, part, _, _ in names["rows"]}
        self.assertEqual(taken[0], 0.)
        self.assertGreater(taken[.1], .5)
        self.assertLess(taken[.2] - taken[.1], taken[.1])
        self.assertLess(taken[.3] - taken[.2], taken[.2] - taken[.1])

    def test_why_does_my_contact_force_oscillate(self):
        names, printed, figures = self.run_cells("why_does_my_contact_force_oscillate")
        self.assertEqual(len(figures), 3)
        off = {}
        for mass in ("consistent", "redistributed"):
            off[mass] = {}
            for name, run in names[mass].items():
                table = run.table
                part = (table["time"] > 3.2) & (table["time"] < 3.9)
                off[mass][name] = largest(table["stress_pressure_left"][part])
        # Crank-Nicolson and the hybrid keep the oscillations, HHT damps a little,
        # TR-BDF2 nearly all.
        swings = off["consistent"]
        for name in ("HHT, alpha = 0.05", "HHT, alpha = -0.02"):
            self.assertLess(swings[name], .9 * swings["Crank-Nicolson"])
            self.assertLess(swings["TR-BDF2"], .5 * swings[name])
        self.assertGreater(swings["Nitsche-hybrid"], .1)
        # Zero to round-off with a boundary without mass, except for the hybrid.
        for name, pressure in off["redistributed"].items():
            if name == "Nitsche-hybrid":
                self.assertGreater(pressure, .1)
            else:
                self.assertLess(pressure, 1e-14, msg=name)
        # The modified energy falls by 5 per cent in the first step.
        energy = names["redistributed"]["Crank-Nicolson"].table["modified_energy"]
        self.assertAlmostEqual(energy[1] / energy[0], .95, delta=.005)
        # A finer mesh: faster oscillations, not smaller ones.
        curves = [line for line in figures[2].axes[0].lines
                  if line.get_label().startswith("h =")]
        heights = []
        for curve in curves:
            time, pressure = curve.get_data()
            heights.append(max(pressure[(time > 1.) & (time < 3.)]))
        self.assertEqual(len(heights), 3)
        self.assertGreater(min(heights), .9 * heights[0])


if __name__ == "__main__":
    main()
