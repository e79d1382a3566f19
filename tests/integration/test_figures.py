# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures as they are written down: one file each, found by their names, with what
they need. What they show is checked by figures/make.py itself."""

import collections
import pathlib
import tempfile

from common import *

FIGURES = ROOT / "figures"
sys.path.insert(0, str(FIGURES))

try:
    import matplotlib
    matplotlib.use("Agg")
    from shared import finding, measures, paper_numbers, report
    from ricochet import RicochetError
except ImportError:
    matplotlib = None


@unittest.skipIf(matplotlib is None, "matplotlib, NumPy or VTK is missing")
class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.figures = finding.find()

    def test_names(self):
        """Each file is a figure, and they come in order: figures before tables."""
        files = [*FIGURES.glob("*/figure_*.py"), *FIGURES.glob("*/table_*.py")]
        self.assertEqual(len(self.figures), len(files))
        names = list(self.figures)
        self.assertEqual(names[:4], ["A-2", "A-3", "A-4", "A-5"])
        self.assertLess(names.index("A-9"), names.index("A-10"))
        self.assertLess(names.index("A-15"), names.index("A-T1"))
        self.assertLess(names.index("A-T4"), names.index("B-2"))

    def test_texts(self):
        for name, figure in self.figures.items():
            self.assertTrue(figure.title and figure.caption.endswith("."), name)
            self.assertTrue(figure.draw or figure.table, name)

    def test_runs(self):
        """Parameter files are there; a folder is that of one run."""
        runs = {}
        for figure in self.figures.values():
            for run in figure.runs:
                self.assertEqual(runs.setdefault(run.folder, run), run)
                self.assertTrue((ROOT / "parameter_files" / run.parameter_file).exists(), run)

    def test_numbers_of_tables(self):
        """Round-off is shown as zero, powers of ten as such."""
        for value, text in ((2.78e-17, "0"), (0., "0"), (1.54e-2, "1.54·10⁻²"),
                            (-3.8e-3, "-3.80·10⁻³"), (12345., "1.23·10⁴")):
            self.assertEqual(measures.scientific(value), text)
        self.assertEqual(measures.scientific_span([0., 4.5e-3]), "0 to 4.50·10⁻³")
        self.assertEqual(measures.scientific_span([1.361e-4, 1.359e-4]), "1.36·10⁻⁴")

    def test_checks_of_other_figures_remain(self):
        check = collections.namedtuple(
            "check", "figure quantity paper exact ours status criterion")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "checks.csv"
            for figure, ours in (("A-1", 1), ("A-2", 2), ("A-1", 3)):
                report.write_csv([check(figure, "q", "-", "-", ours, "yes", "c")], path)
            rows = path.read_text().splitlines()
        self.assertEqual(rows[1:], ["A-2,q,-,-,2,yes,c", "A-1,q,-,-,3,yes,c"])

    def test_list(self):
        result = subprocess.run([sys.executable, FIGURES / "make.py", "--list"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([line.split()[0] for line in result.stdout.splitlines()],
                         list(self.figures))

    def test_paper_numbers(self):
        """Each place has a source; what is not there is an error that tells what is."""
        numbers = paper_numbers.numbers
        everything = paper_numbers.everything()
        self.assertEqual(set(everything), {"A", "B", "C"})
        for paper, places in everything.items():
            for place in places:
                self.assertIn("section", numbers(f"{paper}.{place}")["source"])
        self.assertEqual(numbers("A.table_1")["persistent"], 1.54e-2)
        for place, name, message in (
                ("A.table_1", "inc7", "no 'inc7' in [A.table_1] of figures/paper_numbers.toml; "
                 "there are source, signorini,"),
                ("A.table_9", "", "no 'table_9' in [A] of figures/paper_numbers.toml"),
                ("D.table_1", "", "no 'D' in figures/paper_numbers.toml; there are A, B, C.")):
            with self.assertRaises(RicochetError) as context:
                numbers(place)[name]
            self.assertIn(message, str(context.exception))


if __name__ == "__main__":
    main()
