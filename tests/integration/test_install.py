# SPDX-License-Identifier: LGPL-2.1-or-later
"""The installation works in its folder: programs, a user's own step that is built against the
library, the commands in Python; exported symbols of the library."""

from common import *


class Installed(ProgramTest):

    def call(self, *command):
        result = subprocess.run([str(word) for word in command], capture_output=True,
                                text=True, timeout=600, cwd=self.folder)
        self.assertEqual(result.returncode, 0,
                         msg=f"{command}\n{result.stdout}\n{result.stderr}")
        return result.stdout

    def test_install(self):
        prefix, build = self.folder / "there", self.folder / "build"
        self.call("cmake", "--install", pathlib.Path(program_path("ricochet")).parent,
                  "--prefix", prefix)
        # The whole is moved: nothing may remember where it was.
        moved = prefix.rename(self.folder / "here")
        programs = moved / "bin"
        self.assertIn("Ricochet", self.call(programs / "ricochet", "--version"))
        share = moved / "share" / "ricochet"
        self.call(programs / "ricochet", share / "examples" / "colliding_bars.prm",
                  "--validate")

        # A user's own step, from the folder that was installed.
        self.call("cmake", "-S", share / "examples" / "own_step", "-B", build,
                  f"-DCMAKE_PREFIX_PATH={moved}", "-DCMAKE_BUILD_TYPE=Release")
        self.call("cmake", "--build", build)
        self.call(build / "own_step", "--output-dir", self.folder / "run", "--quiet",
                  "--set", "Output/Fields every=0")
        ledger = Ledger(self.folder / "run")
        self.assertGreater(max(ledger["contact_force_ground"]), 1e3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-11)
        # A body that falls by h on the ground has the energy m g h.
        self.assertAlmostEqual(max(ledger["external_work"]), 500. * 9.81 * .1,
                               delta=.2 * 500. * 9.81 * .1)
        # Laws, material and scheme that the library does not know.
        def run_own(name, *settings):
            options = [word for setting in settings for word in ("--set", setting)]
            self.call(build / "own_step", "--output-dir", self.folder / name, "--quiet",
                      "--set", "Output/Fields every=0",
                      "--set", "Contact/Treatment=exponential pressure",
                      "--set", "Material/Law=Gent", *options)
            ledger = Ledger(self.folder / name)
            self.assertGreater(max(ledger["contact_force_ground"]), 1e3)
            self.assertLess(largest(ledger["balance_residual"]), 1e-9)
            return ledger

        # The promise of the law is checked by the program itself, which ends with 0.
        run_own("own_law", "Contact/Friction law=limited by shear",
                "Contact/Shear strength=100")
        slow = run_own("own_scheme", "Time/Scheme=backward Euler")
        self.assertGreater(slow["numerical_dissipation"][-1], 0.)
        listed = self.call(build / "own_step", "--print-parameters")
        for words in ("Exponential length", "Shear strength", "Gent limit", "backward Euler"):
            self.assertIn(words, listed)

        self.call(sys.executable, programs / "ricochet-plot", self.folder / "run",
                  "-o", self.folder / "pictures")
        self.assertTrue(list((self.folder / "pictures").glob("*.png")))


class Symbols(ProgramTest):

    def test_nothing_of_eigen_is_shared(self):
        """Gmsh has Eigen's functions, too, with another alignment: whose are found first
        would serve both, and Gmsh freed memory that it had not got so."""
        folder = pathlib.Path(program_path("ricochet")).parent
        n_symbols = 0
        for file in (*folder.glob("libricochet.so*"), folder / "ricochet",
                     folder / "spectral_radius", folder / "tests" / "unit_tests"):
            symbols = subprocess.run(["nm", "-D", "--defined-only", file],
                                     capture_output=True, text=True, check=True).stdout
            self.assertEqual([line for line in symbols.splitlines() if "5Eigen" in line],
                             [], msg=file)
            n_symbols += len(symbols.splitlines())
        self.assertGreater(n_symbols, 1000)


if __name__ == "__main__":
    main()
