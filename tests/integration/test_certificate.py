# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error bars: --certify against its formula, computed here from the summaries of its runs, and against
exact solutions of bars; what is refused."""

import json
import math

from common import *

sys.path.insert(0, str(ROOT / "examples/verification"))
import certificate  # noqa: E402

BLOCK = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape         = rectangle
  set Size          = 1, 1
  set Cells along   = 2, 2
  set Translation   = 0, 0.05
  set Velocity      = 0, -1
  set Young modulus = 1e4
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface   = block: lower
  set Against   = floor
  set Treatment = {treatment}
end
subsection Time
  set Final time = 0.25
  set Time step  = 0.005
end
"""
RUNS = ["", "cells_2_steps_2", "cells_4_steps_4", "cells_2", "steps_2"]


class Certificate(ProgramTest):
    def certify(self, text):
        file = self.folder / "block.prm"
        file.write_text(text)
        code, out, err = self.attempt("ricochet", NO_FIELDS, prm=file, options=["--certify"])
        self.assertEqual((code, err), (0, ""), msg=out)
        folder = self.folder / "run"
        summaries = [
            json.loads((folder / ("certificate/" + name if name else "") / "summary.json")
                       .read_text()) for name in RUNS]
        return json.loads((folder / "certificate.json").read_text()), summaries, out

    def test_bars_are_those_of_the_formula(self):
        """Each number of each run is that of its summary; order, bar and changes follow."""
        answer, summaries, out = self.certify(BLOCK.format(treatment="improved normal compliance"))
        self.assertEqual(answer["runs"], RUNS)
        for k, (cells, steps) in enumerate(((4, 50), (16, 100), (64, 200), (16, 50), (4, 100))):
            folder = self.folder / "run" / ("certificate/" + RUNS[k] if k else "")
            self.assertIn(f"{cells} cells", (folder / "log.txt").read_text())
            self.assertEqual(summaries[k]["steps"]["number"], steps)
            self.assertAlmostEqual(summaries[k]["steps"]["end"], 0.25, 12)
            # Each run counts its own.
            run = summaries[k]["run"]
            self.assertLess(run["processor_seconds"], 1.5 * run["wall_seconds"] + 0.05)

        def number(summary, name):
            for key in name.split("."):
                summary = summary[key]
            return summary["value"] if isinstance(summary, dict) else summary

        with_bar = 0
        for name, entry in answer["numbers"].items():
            values = [number(summary, name) for summary in summaries]
            self.assertEqual(entry["values"], values[:3], msg=name)
            self.assertEqual(entry["value"], values[0])
            self.assertAlmostEqual(entry["change_by_halved_cells"], values[3] - values[0], 12)
            self.assertAlmostEqual(entry["change_by_halved_steps"], values[4] - values[0], 12)
            d1, d2 = values[1] - values[0], values[2] - values[1]
            if entry["order"] is not None:
                self.assertAlmostEqual(entry["order"], math.log2(d1 / d2), 9)
            elif min(abs(d1), abs(d2)) > max(0.01, 0.01 * abs(values[0])) and "touch" not in name:
                self.assertLess(d1 * d2, 0, msg=name)
            if entry["error_bar"] is not None and values[0]:
                self.assertIn(f"finest {values[2]:.6g})", out)
            least = 0.01 if "touch" in name else 0
            if entry["error_bar"] is not None and max(abs(d1), abs(d2)) > max(least, 1e-5):
                ratio = abs(d1) / abs(d2)
                self.assertGreater(ratio, 1.1)
                distance = abs(d1 + d2) + abs(d2) / (min(ratio, 64) - 1)
                self.assertAlmostEqual(entry["error_bar"] / max(3 * distance, 3 * abs(d1), least),
                                       1, 9, msg=name)
                with_bar += 1
            self.assertEqual(entry["error_bar"] is None, "why_none" in entry)
            if "why_none" in entry:
                self.assertIn(f"no bar: {entry['why_none']}", out)
        self.assertGreater(with_bar, 2)

    def test_exact_solutions_of_bars(self):
        """Eight bars of the study: nearly all bars hold, more than a half of the numbers have one, and bars
        of a hundredth of the length do not hold."""
        os.environ["RICOCHET_PROGRAMS"] = str(pathlib.Path(program_path("bar_sd")).parent)
        results = certificate.study(8, seed=7)
        self.assertEqual(len(results), 8)
        _, n, with_bar, held, ratio = certificate.rows(results)[-1]
        self.assertGreater(with_bar, 0.5 * n)
        self.assertGreater(held, 0.9 * with_bar)
        self.assertLess(ratio, 5)
        for result in results:
            for number in result["numbers"].values():
                if number["error_bar"] is not None:
                    number["error_bar"] *= 0.01
        self.assertLess(certificate.rows(results)[-1][3], 0.5 * with_bar)

    def test_exact_numbers(self):
        """The exact numbers of the study against those of the library's solution."""
        for program, sides in (("bar_sd", ["left"]), ("bar_ss", ["left", "right"])):
            ledger = self.run_program(
                program, [*NO_FIELDS, "Time/Final time=8.5", "Time/Time step=0.1",
                          "Mesh/Mesh size=0.1"])
            for end in (0.5, 1.5, 3.2, 5.5, 8.5):
                numbers = certificate.exact(program, end)
                self.assertAlmostEqual(numbers["energy.at_end.all"],
                                       0.125 if program == "bar_sd" else 0.25, 12)
                for side in sides:
                    # Constant between integers: the sums are exact.
                    pressures = [p for p, t in zip(ledger[f"exact_pressure_{side}"], ledger["time"])
                                 if t < end - 1e-9]
                    self.assertAlmostEqual(numbers[f"contacts.{side}.largest_force"],
                                           max(0, *pressures), 9)
                    self.assertAlmostEqual(numbers[f"contacts.{side}.impulse_of_force"],
                                           0.1 * sum(max(0, p) for p in pressures), 9)

    def test_what_is_refused(self):
        phases = self.folder / "phases.prm"
        phases.write_text(BLOCK.format(treatment="penalty") +
                          "subsection Phase fall\nend\nsubsection Phase rest\nend\n")
        for program, kwargs, text in (
                ("ricochet", {"prm": phases}, "without phases"),
                ("bar_sd", {"parameters": ["Time/Scheme=ARKODE"]}, "ARKODE"),
                ("colliding_disks", {}, "no parameter gives the mesh"),
                ("bar_by_hand", {}, "time loop")):
            with self.subTest(program):
                code, out, err = self.attempt(program, options=["--certify"], **kwargs)
                self.assertEqual(code, 1, msg=out + err)
                self.assertIn(text, err)
                self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    main()
