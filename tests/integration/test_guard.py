# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arithmetic of the guard of speed, with timings that were made up; and refused input."""

import contextlib
import io

from common import *

sys.path.insert(0, str(ROOT / "benchmarks"))

import guard  # noqa: E402


def timing(seconds, cpu=1., iterations=7):
    return {"seconds": seconds, "cpu": cpu, "unknowns": 10, "iterations": iterations,
            "memory": 100.}


class Guard(ProgramTest):
    def judge(self, cases, **options):
        """Result of the guard for series of runs, {name: (before, now)}.

        @return the slower ones, the table's rows, and in which order runs were asked for
        """
        series = {name: tuple(map(iter, both)) for name, both in cases.items()}
        n_pairs = len(next(iter(cases.values()))[0])
        asked = []

        def run(name, which):
            asked.append(which)
            return next(series[name][which])

        table = io.StringIO()
        with contextlib.redirect_stdout(table):
            slower = guard.judge(list(cases), run, n_pairs, options.pop("bound", 1.25),
                                 **options)
        return slower, table.getvalue().splitlines()[2:], asked

    def test_median_of_ratios(self):
        """One pair that others disturbed neither makes a case slower nor hides that it is."""
        same = [timing(2.), timing(2.), timing(2.)]
        slower, rows, asked = self.judge(
            {"disturbed": (same, [timing(9.), timing(2.2), timing(2.)]),
             "slow": (same, [timing(2.6), timing(1.), timing(2.8)])})
        self.assertEqual(slower, ["slow"])
        self.assertIn("1.10 (1.00 to 4.50)", rows[0])
        self.assertNotIn("SLOWER", rows[0])
        self.assertIn("1.30 (0.50 to 1.40)", rows[1])
        self.assertIn("SLOWER", rows[1])
        self.assertEqual(asked, 2 * [0, 1, 1, 0, 0, 1])

    def test_bound(self):
        """The bound itself is allowed."""
        pairs = {"case": ([timing(4.)], [timing(5.)])}
        self.assertEqual(self.judge(pairs)[0], [])
        self.assertEqual(self.judge(pairs, bound=1.2)[0], ["case"])

    def test_clock(self):
        """Seconds of the processor include parts that those in the steps do not."""
        pairs = {"case": ([timing(1., cpu=2.)], [timing(1., cpu=3.)])}
        self.assertEqual(self.judge(pairs)[0], [])
        self.assertEqual(self.judge(pairs, clock="cpu")[0], ["case"])

    def command(self, *words):
        return subprocess.run([sys.executable, str(ROOT / "benchmarks" / "guard.py"), *words],
                              capture_output=True, text=True, cwd=self.folder)

    def test_refusals(self):
        for words, message in ((["--against", "no_such_commit"], "git knows no commit"),
                               (["--against-build", str(self.folder)],
                                "there is no program"),
                               (["--against-build", ".", "--pairs", "0"], "at least 1")):
            with self.subTest(" ".join(words)):
                result = self.command(*words)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(message, result.stderr)

    def test_cases(self):
        """Each case is known to its program: it prints its parameters, and does not run."""
        for name, case in guard.CASES.items():
            with self.subTest(name):
                words = [program_path(case.program)]
                if case.scene:
                    (self.folder / "scene.prm").write_text(case.scene)
                    words.append(str(self.folder / "scene.prm"))
                elif case.file:
                    words.append(str(ROOT / case.file))
                for parameter in case.parameters:
                    words += ["--set", parameter]
                result = subprocess.run(words + ["--validate"], capture_output=True,
                                        text=True)
                self.assertEqual(result.returncode, 0, msg=result.stderr)


if __name__ == "__main__":
    main()
