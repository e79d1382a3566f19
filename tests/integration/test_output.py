# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a run: all there, readable, and consistent with each other."""

import json
import xml.etree.ElementTree as ElementTree

from common import *


class Output(ProgramTest):

    def test_folder_of_a_run(self):
        given = self.folder / "mine.prm"
        given.write_text("subsection Time\n  set Final time = 1\nend\n")
        ledger = self.run_program("bar_sd", prm=given)
        run = self.folder / "run"
        for name in ("log.txt", "mine.prm", "parameters.prm", "energy.csv",
                     "energy.h5", "solution.pvd"):
            self.assertTrue((run / name).exists(), msg=name)
        self.assertEqual((run / "mine.prm").read_text(), given.read_text())
        self.assertEqual(len(ledger["time"]), 21)
        self.assertTrue(all(ledger.units))

        # All values are in parameters.prm: it alone gives the same run.
        again = self.run_program("bar_sd", prm=run / "parameters.prm",
                                 folder=self.folder / "again")
        self.assertEqual(ledger.columns, again.columns)

    def test_summary_for_scripts(self):
        """The numbers of summary.json are those of the table, computed here once more; a run
        that fails leaves the summary of its steps."""
        parameters = BALL + NO_FIELDS + ["Contact/Treatment=improved normal compliance",
                                         "Contact/Friction coefficient=0.2"]
        ledger = self.run_program("elastic_ball", parameters, options=["--quiet"])
        summary = json.loads((self.folder / "run" / "summary.json").read_text())
        self.assertEqual(summary["program"], "elastic_ball")
        self.assertEqual(summary["run"]["state"], "complete")
        self.assertIn("--quiet", summary["command_line"])
        self.assertIn("Contact/Friction coefficient=0.2", summary["command_line"])
        steps = summary["steps"]
        self.assertEqual(steps["number"], len(ledger["time"]) - 1)
        self.assertEqual(steps["end"], ledger["time"][-1])
        self.assertEqual(steps["newton_iterations_at_most"], max(ledger["newton_iterations"]))
        energy = summary["energy"]
        stored = [m - e for m, e in zip(ledger["modified_energy"], ledger["energy"])]
        self.assertAlmostEqual(energy["lost"]["contact"],
                               ledger["contact_work"][-1] - stored[-1] + stored[0], places=12)
        self.assertGreater(energy["lost"]["friction"], 0.)
        # Losses and the rest add up to the energy of the start.
        lost = sum(energy["lost"].values())
        self.assertAlmostEqual(
            (energy["at_end"]["all"] + lost) / energy["at_start"]["all"], 1., places=9)
        (contact,) = summary["contacts"].values()
        (name,) = summary["contacts"]
        force = ledger["contact_force_" + name]
        self.assertEqual(contact["largest_force"]["value"], max(force))
        self.assertEqual(contact["largest_force"]["time"],
                         ledger["time"][force.index(max(force))])
        touching = [t for t, f in zip(ledger["time"], force) if f > 0.]
        self.assertEqual(contact["first_touch"], touching[0])
        self.assertEqual(contact["last_touch"], touching[-1])
        self.assertEqual(set(summary["columns"]), set(ledger.names))
        for column, unit in zip(ledger.names, ledger.units):
            found = summary["columns"][column]
            values = [v for v in ledger[column] if v == v]
            self.assertEqual(found["unit"], unit)
            for which, value in (("least", min(values, default=None)),
                                 ("largest", max(values, default=None))):
                self.assertEqual(found[which]["value"], value, msg=column)
        self.assertTrue(summary["checks"]["balance"]["closes"])
        self.assertTrue(summary["checks"]["total_energy"]["kept"])
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertIn("; lost to contact ", log)
        self.assertIn(f"contact {name}: largest force ", log)

        self.attempt("bar_sd", ["Newton/Maximum iterations=1", "Time/Maximum halvings=0"],
                     folder=self.folder / "failed")
        summary = json.loads((self.folder / "failed" / "summary.json").read_text())
        self.assertEqual(summary["run"]["state"], "failed")
        self.assertIn("after 0 halvings", summary["run"]["reason"])
        self.assertGreater(summary["steps"]["number"], 15)

    def test_fields(self):
        self.run_program("bar_ss", ["Time/Final time=1", "Output/Fields every=4"])
        run = self.folder / "run"
        sets = ElementTree.parse(run / "solution.pvd").findall(".//DataSet")
        self.assertEqual([float(s.get("timestep")) for s in sets],
                         [0, .2, .4, .6, .8, 1])
        for entry in sets:
            text = (run / entry.get("file")).read_text()
            for field in ("displacement", "velocity", "acceleration", "stress",
                          "contact_pressure", "gap", "TIME"):
                self.assertIn(f'Name="{field}"', text)

    def test_fields_in_the_plane(self):
        """Von Mises stress in 2D too; a second run writes the same bytes."""
        parameters = BALL + ["Time/Final time=0.002", "Output/Fields every=2"]
        self.run_program("elastic_ball", parameters)
        file = self.folder / "run" / "solution" / "step-000002.vtu"
        before = file.read_bytes()
        for field in (b"von_mises", b"gap", b"contact_pressure"):
            self.assertIn(b'Name="%s"' % field, before)
        self.run_program("elastic_ball", parameters)
        self.assertEqual(file.read_bytes(), before)

    def test_fields_agree_with_the_table(self):
        """Sums over the nodes of a picture are columns of the table: forces on the
        body point up, gaps are heights above the foundation."""
        sys.path.insert(0, str(ROOT / "figures"))
        try:
            from shared import meshes
        except ImportError:
            self.skipTest("NumPy or VTK (Debian's python3-numpy, python3-vtk9) is missing")
        ledger = self.run_program("elastic_ball", BALL + [
            "Time/Final time=0.01", "Output/Fields every=10"])
        points, _, fields = meshes.read(
            self.folder / "run" / "solution" / "step-000010.vtu")
        force = fields["contact_force"].sum(axis=0)
        self.assertGreater(ledger["contact_force_foundation"][-1], 0)
        self.assertAlmostEqual(force[1] / ledger["contact_force_foundation"][-1], 1,
                               places=5)
        self.assertLess(abs(force[0]), 1e-5 * force[1])
        gap = fields["gap"].reshape(-1)
        self.assertAlmostEqual(gap.min(), ledger["smallest_gap_foundation"][-1],
                               places=6)
        height = points[:, 1] + fields["displacement"][:, 1]
        self.assertLess(abs(gap - height).max(), 1e-5)
        pressure = fields["contact_pressure"].reshape(-1)
        self.assertEqual(pressure.argmax(), fields["contact_force"][:, 1].argmax())
        self.assertGreater(fields["von_mises"].max(), 0)

    def test_gaps(self):
        """The smallest gap of the ball is the parameter; the mean one is that of
        its whole circle, radius + gap."""
        ledger = self.run_program(
            "elastic_ball", BALL + NO_FIELDS + ["Time/Final time=0.002"])
        self.assertAlmostEqual(ledger["smallest_gap_foundation"][0], .0155)
        self.assertAlmostEqual(ledger["mean_gap_foundation"][0], 10.0155)
        # The ball falls by 10 m/s, free of forces.
        self.assertAlmostEqual(ledger["smallest_gap_foundation"][1], .0055)

    def test_a_method_without_potential_has_no_modified_energy(self):
        for theta in ("-1", "0"):
            self.run_program("bar_sd", NO_FIELDS + [
                "Time/Final time=1.5", f"Contact/Nitsche theta={theta}"])
            table = (self.folder / "run" / "energy.csv").read_text().splitlines()
            column = [name.split(" [")[0] for name in
                      table[0].split(",")].index("modified_energy")
            self.assertEqual({row.split(",")[column] for row in table[1:]}, {""})
        # The run is resumed all the same.
        self.run_program("bar_sd", NO_FIELDS + [
            "Time/Final time=2", "Contact/Nitsche theta=0",
            "Output/Checkpoint every=10"])
        self.run_program("bar_sd", NO_FIELDS + [
            "Time/Final time=3", "Contact/Nitsche theta=0"],
            options=["--resume"])

    def test_hdf5_holds_the_same_table(self):
        ledger = self.run_program("bar_sd", ["Time/Final time=1"] + NO_FIELDS)
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py (Debian's python3-h5py) is missing")
        with h5py.File(self.folder / "run" / "energy.h5") as file:
            self.assertEqual(sorted(file), sorted(ledger.names))
            for name, unit in zip(ledger.names, ledger.units):
                self.assertEqual(list(file[name]), list(ledger[name]))
                attribute = file[name].attrs["unit"]
                if isinstance(attribute, bytes):
                    attribute = attribute.decode()
                self.assertEqual(attribute, unit)

    def test_newton_table(self):
        """One line per residual: a step has one more than linear solves."""
        ledger = self.run_program("bar_ss", ["Output/Newton table=true"])
        lines = [line.split() for line in
                 (self.folder / "run" / "log.txt").read_text().splitlines()
                 if line.lstrip().startswith("Newton")]
        n_steps = len(ledger["time"]) - 1
        self.assertEqual(len(lines), sum(ledger["newton_iterations"]) + n_steps)
        # The last residual of each step is below the tolerance, and both ends
        # of the bar are counted as contact points.
        for line, following in zip(lines, lines[1:] + [["Newton", "0"]]):
            self.assertEqual(line[-2:], ["of", "2"])
            if following[1] == "0":
                self.assertLess(float(line[3]), 1e-12)

    def test_newton_stops_where_it_was_told_to_with_multipliers(self):
        """Pressures are not lengths: the round-off that is forgiven is that of
        displacements (with pressures among them it was 1e-5)."""
        for treatment in ("Signorini multipliers", "proximal augmented Lagrangian"):
            self.run_program("elastic_ball", BALL + NO_FIELDS + [
                f"Contact/Treatment={treatment}", "Output/Newton table=true",
                "Time/Final time=0.02"])
            lines = [line.split() for line in
                     (self.folder / "run" / "log.txt").read_text().splitlines()
                     if line.lstrip().startswith("Newton")]
            checked = 0
            for line, following in zip(lines, lines[1:] + [["Newton", "0"]]):
                # In free flight all forces are round-off.
                if following[1] == "0" and line[7] != "0":
                    self.assertLess(float(line[3]), 1e-11)
                    checked += 1
            self.assertGreater(checked, 5)

    def test_help_and_version(self):
        for program in ("bar_sd", "bar_ss", "spectral_radius"):
            code, out, _ = self.attempt(program, options=["--help"])
            self.assertEqual(code, 0)
            self.assertIn("--print-parameters", out)
            code, out, _ = self.attempt(program, options=["--version"])
            self.assertEqual(code, 0)
            self.assertIn("deal.II", out)


if __name__ == "__main__":
    main()
