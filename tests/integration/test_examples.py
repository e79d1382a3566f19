# SPDX-License-Identifier: LGPL-2.1-or-later
"""The quickest examples show the numbers that their files promise; the others
name parameters that exist."""

import pathlib
import sys
import unittest

import common
from common import ROOT, ProgramTest, is_debug_build, main

sys.path.insert(0, str(ROOT / "examples"))

try:
    import check
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

    def test_a_wrong_number_is_found(self):
        self.assertTrue(check.is_good(check.near("a", 1.001, 1., .01)))
        self.assertFalse(check.is_good(check.near("a", 1.02, 1., .01)))
        self.assertFalse(check.is_good(check.near("a", float("nan"), 1., .01)))
        self.assertTrue(check.is_good(check.between("a", 1., 0., 2.)))
        self.assertFalse(check.is_good(check.between("a", 3., 0., 2.)))

    def test_all_files_are_valid(self):
        files = sorted((ROOT / "examples").glob("*.prm"))
        self.assertEqual([path.stem for path in files], sorted(check.EXAMPLES))
        for path in files:
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
