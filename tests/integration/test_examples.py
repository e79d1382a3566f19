# SPDX-License-Identifier: LGPL-2.1-or-later
"""The quickest examples show the numbers that their files promise; the others
name parameters that exist."""

import csv
import pathlib
import sys
import unittest

import common
from common import ROOT, ProgramTest, is_debug_build, main

sys.path[:0] = [str(ROOT / "examples"), str(ROOT / "examples" / "verification")]

try:
    import check
    import verification
except ImportError:
    check = None


@unittest.skipIf(check is None, "NumPy (Debian's python3-numpy) is missing")
class Examples(ProgramTest):
    def test_numbers(self):
        if is_debug_build():
            self.skipTest("the release build runs them")
        names = [name for name, (_, quick) in check.EXAMPLES.items() if quick]
        self.assertEqual(len(names), 3)
        for name in names:
            folder = self.folder / name
            check.run_example(name, common.arguments.programs, folder)
            for number in check.checks_of(name, folder):
                with self.subTest(f"{name}: {number.what}"):
                    self.assertTrue(check.is_good(number), msg=str(number))

    def test_cases_of_other_codes(self):
        """Numbers of smith, 4C, Code_Aster, Ansys and MOOSE, of Hertz, Lame and Heyman, and by
        hand."""
        if is_debug_build():
            self.skipTest("the release build runs them")
        for name in verification.QUICK:
            for number in verification.compute(name, common.arguments.programs, self.folder):
                with self.subTest(f"{name}: {number.what}"):
                    self.assertTrue(verification.is_good(number), msg=str(number))

    def test_list_of_cases(self):
        """The list for programs has the cases, and the numbers of the page."""
        with open(verification.LIST, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(dict.fromkeys(row["case"] for row in rows)),
                         list(verification.CASES))
        page = verification.PAGE.read_text(encoding="utf-8")
        for row in rows:
            numbers = [float(row[name]) if row[name] else None
                       for name in ("must be", "bound", "is", "theirs")]
            number = verification.Number(row["quantity"], *numbers)
            with self.subTest(f"{row['case']}: {number.what}"):
                self.assertTrue(verification.is_good(number))
                self.assertIn(f"| {row['title']} | {number.what} | {number.expected:.7g} |", page)

    def test_a_wrong_number_is_found(self):
        self.assertFalse(verification.is_good(verification.Number("a", 1., .01, 1.02)))
        self.assertTrue(verification.is_good(verification.Number("a", -1., .01, -1.009)))
        self.assertTrue(check.is_good(check.near("a", 1.001, 1., .01)))
        self.assertFalse(check.is_good(check.near("a", 1.02, 1., .01)))
        self.assertFalse(check.is_good(check.near("a", float("nan"), 1., .01)))
        self.assertTrue(check.is_good(check.between("a", 1., 0., 2.)))
        self.assertFalse(check.is_good(check.between("a", 3., 0., 2.)))

    def test_all_files_are_valid(self):
        files = sorted((ROOT / "examples").glob("*.prm"))
        self.assertEqual([path.stem for path in files], sorted(check.EXAMPLES))
        cases = sorted((ROOT / "examples" / "verification").glob("*.prm"))
        self.assertEqual([path.stem for path in cases],
                         sorted(set(verification.CASES) - set(verification.VARIANTS)))
        for path in files + cases:
            with self.subTest(path.stem):
                code, _, error = self.attempt("ricochet", options=["--validate"],
                                              prm=path)
                self.assertEqual(code, 0, msg=error)

    def test_pictures_and_table(self):
        table = (ROOT / "examples" / "README.md").read_text()
        for name in check.EXAMPLES:
            with self.subTest(name):
                picture = pathlib.Path("images") / f"{name}.png"
                self.assertLess((ROOT / "examples" / picture).stat().st_size, 120e3)
                self.assertIn(str(picture), table)
                self.assertIn(f"{name}.prm", table)


if __name__ == "__main__":
    main()
