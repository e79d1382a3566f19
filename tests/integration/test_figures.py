# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of the figures: one for each, found by their names, with their runs. Their numbers are
checked by figures/make.py itself."""

import collections
import csv
import pathlib
import tempfile
import unittest.mock

from common import *

FIGURES = ROOT / "figures"
sys.path.insert(0, str(FIGURES))

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot
    from shared import finding, keeping, measures, numbers_table, paper_numbers, report
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

    def test_numbers_are_of_figures(self):
        """Each belongs to a figure, has a source, and ours beside it."""
        everything = paper_numbers.everything()
        self.assertEqual({name.partition(".")[0] for name in everything},
                         {"A", "B", "C", "own"})
        for name, number in everything.items():
            with self.subTest(name):
                self.assertIn(number.figure, self.figures)
                self.assertTrue(number.source.startswith(
                    "our own" if name.startswith("own.") else "section "))
                self.assertIsNotNone(number.ours)
                self.assertFalse((number.why or number.tried) and number.paper is None)
        with self.assertRaises(RicochetError) as context:
            paper_numbers.compare("A.table_1.inc7", 1.)
        self.assertIn("no number 'A.table_1.inc7'", str(context.exception))
        self.assertGreater(sum(number.paper is not None for number in everything.values()), 120)

    def test_numbers_fail_on_both_sides(self):
        """A number out of its band fails, and so does a reason that is not needed, or is missing."""
        number = paper_numbers.PaperNumber
        common = ("A.x.y", "A-1", "section 1", "y")
        met = number(*common, paper=2., ours=2.02)
        differs = number(*common, paper=3., ours=2.02, why="another machine")
        statement = number(*common, paper="less", holds=[0, 1], ours=[.5, .9])
        for which, ours, passes in (
                (met, 2.02, True), (met, 2.05, False), (met, 1.99, False),
                (differs, 2.02, True), (differs, 2.05, False),
                (number(*common, paper=2., ours=2.02, why="not so"), 2.02, False),
                (number(*common, paper=3., ours=2.02), 2.02, False),
                (number(*common, ours=2.02), 2.02, True),
                (number(*common, ours=None), 2.02, False),
                (statement, [.5, .9], True), (statement, [.5, .8], False),
                (number(*common, paper="less", holds=[0, 1], ours=[.5, 1.1]), [.5, 1.1], False),
                (number(*common, paper=[.6, .7], ours=[.5, .9]), [.5, .9], True),
                (number(*common, paper=0, ours=0, tolerance=1e-9), 1e-12, True),
                (number(*common, paper=0, ours=0, tolerance=1e-9), -1e-8, False)):
            with self.subTest(number=which, ours=ours), \
                    unittest.mock.patch.object(paper_numbers, "paper_number", lambda _: which):
                row = paper_numbers.compare("A.x.y", ours)
                self.assertEqual(row.status != "NO", passes, row)
        self.assertEqual(met.verdict, "equal within 1 %")
        self.assertEqual(differs.verdict, "differs: another machine")
        self.assertEqual(statement.verdict, "holds")

    def test_kept_figures(self):
        """Each figure that takes no quiet machine has a small picture or a table, date and commit,
        and all numbers that are written down for it; there is nothing else."""
        wanted = {name: figure for name, figure in self.figures.items() if not figure.timed}
        made = keeping.made()
        self.assertEqual(set(made), set(wanted))
        for date, commit in made.values():
            self.assertRegex(f"{date} {commit}", r"^20\d\d-\d\d-\d\d [0-9a-f]{10}$")
        files = {file for figure in wanted.values()
                 for file in (figure.image, figure.table_file) if file}
        kept = {path.name for path in keeping.FOLDER.iterdir()}
        self.assertEqual(kept, files | {"made.csv", "checks.csv"})
        for file in files:
            self.assertLessEqual((keeping.FOLDER / file).stat().st_size, keeping.LARGEST)
        with open(keeping.FOLDER / "checks.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["ok?"] for row in rows}, {"yes", "differs"})
        checked = {(row["figure"], row["quantity"]) for row in rows}
        for number in paper_numbers.everything().values():
            if number.figure in wanted:
                self.assertIn((number.figure, number.quantity), checked)

    def test_small_copies(self):
        """A picture of noise, which nothing makes small, is refused; a drawing fits, at its size on
        paper."""
        from PIL import Image
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            plot, small = folder / "plot.png", folder / "small.png"
            figure, axes = matplotlib.pyplot.subplots(figsize=(6.8, 4))
            axes.plot([0, 1, 4, 9])
            figure.savefig(plot, dpi=300)
            matplotlib.pyplot.close(figure)
            keeping.small_copy(plot, small)
            self.assertLessEqual(small.stat().st_size, keeping.LARGEST)
            with Image.open(small) as image:
                self.assertAlmostEqual(image.width / image.info["dpi"][0], 6.8, places=1)
            Image.effect_noise((1600, 1600), 100).save(plot)
            with self.assertRaisesRegex(RicochetError, "no copy of 40000 bytes"):
                keeping.small_copy(plot, small)

    def test_table_of_numbers(self):
        """doc/benchmarks.md has the table that figures/make.py --table would write."""
        page = numbers_table.FILE.read_text(encoding="utf-8")
        self.assertEqual(page, numbers_table.with_table(page))


if __name__ == "__main__":
    main()
