# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark of kernels runs and writes numbers; how large they are is not tested."""

import json
import math

from common import *

TINY = ["Bodies/Elements=hexahedra", "Bodies/Cells=2", "Kernels/Seconds=0",
        "Memory/Megabytes=3"]


class Throughput(ProgramTest):
    def test_numbers(self):
        """Each kernel of both bodies has a time, bytes and a part of the bandwidth."""
        command = [sys.executable, str(ROOT / "benchmarks" / "throughput.py"),
                   "--build-dir", str(pathlib.Path(program_path("sphere")).parent),
                   "--repetitions", "1", "--output-dir", str(self.folder / "out")]
        for assignment in TINY:
            command += ["--set", assignment]
        subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
        result = json.loads((self.folder / "out" / "throughput.json").read_text())
        rows = result["kernels"]
        of_all = {"residual", "tangent", "matrix-vector product", "factorisation",
                  "back-substitution"}
        self.assertEqual({row["kernel"] for row in rows if row["material"] == "neo-Hookean"},
                         of_all)
        self.assertEqual({row["kernel"] for row in rows if row["material"] == "linear"},
                         of_all | {"product by blocks", "multigrid cycle",
                                   "multigrid set-up"})
        for row in rows:
            self.assertEqual(row["unknowns"], 3 * 5 ** 3)
            for key in ("seconds", "bytes", "unknowns_per_second", "bandwidth", "part"):
                self.assertGreater(row[key], 0., (row["kernel"], key))
                self.assertTrue(math.isfinite(row[key]), (row["kernel"], key))
        self.assertGreater(result["start"]["libraries"], 0.)
        self.assertGreater((self.folder / "out" / "throughput.svg").stat().st_size, 1000)


if __name__ == "__main__":
    main()
