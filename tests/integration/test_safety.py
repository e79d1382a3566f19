# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing is lost and nothing silently replaced: full disks, folders that are in
use or hold another run, damaged tables, meshes that changed."""

import re
import resource
import signal
import threading
import time

from common import *

SHORT = ["Time/Final time=3", "Output/Log every=0", "Output/Checkpoint every=5"]


class Safety(ProgramTest):

    def attempt_limited(self, largest_file, *args, **kwargs):
        """Run with a limit on the size of files, which fails as a full disk."""
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                           (largest_file, largest_file))
        result = subprocess.run(self.command(*args, **kwargs), preexec_fn=limit,
                                capture_output=True, text=True, timeout=300,
                                cwd=ROOT)
        return result.returncode, result.stderr

    def whole_files_only(self, run):
        """Whatever is there is whole, but for the end of tables that grow."""
        for file in run.rglob("*"):
            if file.suffix == ".vtu":
                self.assertTrue(file.read_text().rstrip().endswith("</VTKFile>"),
                                msg=file)
            if file.suffix == ".h5":
                self.assertEqual(file.read_bytes()[:8], b"\x89HDF\r\n\x1a\n")
            if file.suffix == ".pvd":
                ends = file.read_text().rstrip()
                self.assertTrue(ends.endswith("</VTKFile>"), msg=file)
            self.assertNotEqual(file.suffix, ".new", msg=file)

    def test_programs_that_start_at_once_share_no_folder(self):
        """One that ended took away what another had just begun to use: now they
        need no folder of temporary files, and start without one."""
        (self.folder / "file").touch()
        environment = dict(os.environ, TMPDIR=str(self.folder / "file" / "below"))
        result = subprocess.run(self.command("bar_sd", SHORT, self.folder / "run"),
                                capture_output=True, text=True, timeout=300,
                                cwd=ROOT, env=environment)
        self.assertEqual(result.returncode, 0, msg=result.stderr)

    def test_a_full_disk_ends_with_the_name_of_the_file(self):
        ball = BALL + ["Time/Final time=0.005", "Output/Fields every=1"]
        for program, parameters, limit, name in (
                ("bar_sd", [], 100, "parameters.prm"),
                ("bar_sd", ["Output/Log every=0"], 40000, "energy.csv"),
                ("elastic_ball", ball, 30000, ".vtu"),
                ("spectral_radius", ["Spectrum/Points=100"], 6000,
                 "spectral_radii.csv")):
            with self.subTest(f"{program} {name}"):
                run = self.folder / f"{program}-{limit}"
                code, error = self.attempt_limited(limit, program, parameters, run)
                self.assertEqual(code, 2, msg=error)
                self.assertIn(f"{name}' cannot be written", error)
                self.assertLess(len(error.splitlines()), 12)
                self.whole_files_only(run)

    def test_a_full_file_system(self):
        """The same on a disk that is full, where one may be mounted."""
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k",
                                  "tmpfs", str(disk)], capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("this machine mounts nothing")
        self.addCleanup(subprocess.run, ["umount", str(disk)])
        parameters = SHORT + ["Output/Fields every=1"]
        code, _, error = self.attempt("bar_sd", parameters, disk / "run")
        self.assertEqual(code, 2, msg=error)
        self.assertIn("cannot be written: No space left on device", error)
        self.whole_files_only(disk / "run")

    def test_a_run_goes_on_when_there_is_room_again(self):
        """The checkpoint is written first, and the table up to it is there."""
        whole = self.folder / "whole"
        self.run_program("bar_sd", SHORT, whole)
        for limit in (15000, 25000):
            with self.subTest(limit):
                parts = self.folder / f"{limit}"
                code, error = self.attempt_limited(limit, "bar_sd", SHORT, parts)
                self.assertEqual(code, 2, msg=error)
                self.run_program("bar_sd", SHORT, parts, options=["--resume"])
                self.assertEqual((whole / "energy.csv").read_bytes(),
                                 (parts / "energy.csv").read_bytes())

    def test_resuming_does_not_touch_the_table_before_it_is_safe(self):
        run = self.folder / "run"
        self.run_program("bar_sd", SHORT)
        before = (run / "energy.csv").read_bytes()
        code, error = self.attempt_limited(len(before) // 2, "bar_sd",
                                           SHORT, options=["--resume"])
        self.assertEqual(code, 2, msg=error)
        self.assertEqual((run / "energy.csv").read_bytes(), before)

    def test_a_failure_of_fields_leaves_the_checkpoint(self):
        """Fields are larger than the rest: with no room for them the run stops,
        and its checkpoint and table of energies are there."""
        run = self.folder / "run"
        parameters = BALL + ["Output/Fields every=3", "Output/Log every=0"]
        self.run_program("elastic_ball", BALL + ["Time/Final time=0.01"] +
                         NO_FIELDS + ["Output/Checkpoint every=10"])
        size = (run / "checkpoint.bin").stat().st_size
        code, error = self.attempt_limited(size + 5000, "elastic_ball",
                                           parameters, self.folder / "full")
        self.assertEqual(code, 2, msg=error)
        self.assertIn(".vtu' cannot be written", error)
        for name in ("checkpoint.bin", "energy.csv", "energy.h5"):
            self.assertTrue((self.folder / "full" / name).exists(), msg=name)

    def test_a_folder_is_locked(self):
        run = self.folder / "run"
        first = subprocess.Popen(
            self.command("bar_sd", ["Time/Final time=400", "Output/Log every=0"]),
            cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            while not (run / "energy.csv").exists():
                self.assertIsNone(first.poll())
                time.sleep(.01)
            for options in ([], ["--resume"], ["--overwrite"]):
                code, _, error = self.attempt("bar_sd", options=options)
                self.assertEqual(code, 1)
                self.assertIn("is in use by another run", error)
        finally:
            first.send_signal(signal.SIGKILL)
            first.communicate()
        # The lock ends with the process.
        self.run_program("bar_sd", SHORT)

    def test_the_run_of_another_file_is_not_overwritten(self):
        mine, other = self.folder / "mine.prm", self.folder / "other.prm"
        mine.write_text("subsection Time\n set Final time = 1\nend\n")
        other.write_text("subsection Time\n set Final time = 2\nend\n")
        run = self.folder / "run"
        self.run_program("bar_sd", prm=mine)
        table = (run / "energy.csv").read_bytes()
        for program, prm in (("bar_sd", other), ("bar_ss", mine),
                             ("bar_sd", None)):
            code, _, error = self.attempt(program, prm=prm)
            self.assertEqual(code, 1, msg=error)
            self.assertIn("holds the results of bar_sd with", error)
            self.assertIn("mine.prm", error)
            self.assertIn("--overwrite", error)
            self.assertEqual((run / "energy.csv").read_bytes(), table)
        # The same file again, also from another place; and the other one when
        # asked to.
        moved = self.folder / "elsewhere"
        moved.mkdir()
        shutil.copy(mine, moved / "mine.prm")
        for prm in (mine, moved / "mine.prm"):
            code, _, error = self.attempt("bar_sd", prm=prm)
            self.assertEqual(code, 0, msg=error)
        ledger = self.run_program("bar_sd", prm=other, options=["--overwrite"])
        self.assertEqual(ledger["time"][-1], 2)
        self.assertFalse((run / "mine.prm").exists())
        code, _, error = self.attempt("bar_sd", prm=other,
                                      options=["--overwrite", "--resume"])
        self.assertEqual(code, 1)
        self.assertIn("give one of them", error)

    def test_a_parameter_file_in_the_output_folder_is_kept(self):
        run = self.folder / "run"
        run.mkdir()
        mine, text = run / "mine.prm", "subsection Time\n set Final time = 1\nend\n"
        mine.write_text(text)
        for options in ([], [], ["--overwrite"]):
            code, _, error = self.attempt("bar_sd", prm=mine, options=options)
            self.assertEqual(code, 0, msg=error)
            self.assertEqual(mine.read_text(), text)
        # Also when another file's run takes its place, and when the values of a
        # run are run again where they are.
        self.run_program("bar_sd", SHORT)
        self.assertEqual(mine.read_text(), text)
        ledger = self.run_program("bar_sd", prm=run / "parameters.prm")
        self.assertEqual(ledger["time"][-1], 3)

    def test_the_default_folder_is_named_after_program_and_file(self):
        given = self.folder / "a_case.prm"
        given.write_text("subsection Time\n set Final time = 0.1\nend\n")
        for words, name in (([str(given)], "a_case"),
                            (["--set", "Time/Final time=0.1"], "without_file")):
            result = subprocess.run([program_path("bar_sd"), *words],
                                    cwd=self.folder, capture_output=True)
            self.assertEqual(result.returncode, 0, msg=result.stderr)
            self.assertTrue((self.folder / "output" / "bar_sd" / name /
                             "energy.csv").exists())

    def test_a_run_that_is_refused_leaves_the_folder_as_it_was(self):
        run = self.folder / "run"
        self.run_program("bar_sd", SHORT)
        before = {file: file.read_bytes() for file in run.rglob("*")
                  if file.is_file()}
        # Refused while it is set up, when the folder is already open.
        code, _, error = self.attempt("bar_sd", ["Contact/Nitsche gamma0=0.5"])
        self.assertEqual(code, 1, msg=error)
        for file, content in before.items():
            self.assertEqual(file.read_bytes(), content, msg=file)

    def test_a_fresh_run_takes_the_old_checkpoint_away(self):
        run = self.folder / "run"
        self.run_program("bar_sd", SHORT + ["Output/Fields every=10"])
        self.run_program("bar_sd", ["Time/Final time=1"] + NO_FIELDS)
        self.assertFalse((run / "checkpoint.bin").exists())
        self.assertFalse((run / "solution.pvd").exists())
        self.assertEqual(list(run.glob("solution/*.vtu")), [])

    def test_surfaces_of_obstacles_that_are_gone(self):
        """Those of an earlier run are taken away; what is lost is not listed."""
        run = self.folder / "run"
        parameters = ["Mesh/Nodes=100", "Mesh/Boundary nodes=32", "Time/Time step=1e-3",
                      "Time/Final time=4e-3", "Output/Checkpoint every=1"]
        self.run_program("elastic_ball", parameters + ["Output/Fields every=1"])
        (run / "solution" / "obstacles-000001.vtu").unlink()
        self.run_program("elastic_ball", parameters + ["Output/Fields every=1",
                                                       "Time/Final time=6e-3"],
                         options=["--resume"])
        listed = re.findall('file="([^"]*)"', (run / "obstacles.pvd").read_text())
        self.assertEqual(len(listed), 6)
        self.assertTrue(all((run / name).is_file() for name in listed))
        self.run_program("elastic_ball", parameters + NO_FIELDS)
        self.assertFalse((run / "obstacles.pvd").exists())
        self.assertEqual(list(run.glob("solution/*.vtu")), [])

    def test_files_where_folders_belong_and_folders_where_files_belong(self):
        run = self.folder / "run"
        for name, make in (("solution", lambda p: p.write_text("")),
                           ("energy.csv", lambda p: p.mkdir()),
                           ("parameters.prm", lambda p: p.mkdir())):
            with self.subTest(name):
                run.mkdir()
                make(run / name)
                code, _, error = self.attempt("bar_sd")
                self.assertEqual(code, 1, msg=error)
                self.assertIn(name, error)
                shutil.rmtree(run)

    def test_fields_of_a_resumed_run(self):
        """A run that was killed before it wrote the fields of its checkpoint."""
        run = self.folder / "run"
        parameters = SHORT + ["Output/Fields every=20"]
        self.run_program("bar_sd", parameters)
        whole = (run / "solution" / "step-000060.vtu").read_bytes()
        (run / "solution" / "step-000060.vtu").unlink()
        self.run_program("bar_sd", parameters, options=["--resume"])
        self.assertEqual((run / "solution" / "step-000060.vtu").read_bytes(),
                         whole)
        self.assertIn("step-000060.vtu", (run / "solution.pvd").read_text())


class DamagedTable(ProgramTest):
    """--resume believes nothing of energy.csv. Each test damages a copy of the same
    run."""

    def setUp(self):
        super().setUp()
        self.copy_of_shared_run("bar_sd", SHORT)
        self.table = self.folder / "run" / "energy.csv"
        self.lines = self.table.read_text().split("\n")

    def refuse(self, message, lines):
        self.table.write_text("\n".join(lines))
        code, _, error = self.attempt("bar_sd", SHORT, options=["--resume"])
        self.assertEqual(code, 1, msg=error)
        self.assertIn(message, " ".join(error.split()))
        self.assertEqual(self.table.read_text(), "\n".join(lines))

    def with_cell(self, row, column, text):
        lines = list(self.lines)
        cells = lines[row].split(",")
        cells[column] = text
        lines[row] = ",".join(cells)
        return lines

    def test_what_is_no_number(self):
        self.refuse("row 7 holds 'abc' where a number is expected",
                    self.with_cell(7, 3, "abc"))
        for text in ("nan", "1.0x", "", " 1", "0x1p3", "inf"):
            self.refuse("where a number is expected", self.with_cell(7, 3, text))

    def test_rows_in_another_order(self):
        lines = list(self.lines)
        lines[10], lines[11] = lines[11], lines[10]
        self.refuse("is not later than the one before", lines)

    def test_another_digit(self):
        number = self.lines[20].split(",")[3]
        other = number.replace("e", "1e") if "e" in number else number + "1"
        self.refuse("not those that were written before the checkpoint",
                    self.with_cell(20, 3, other))

    def test_rows_and_columns_that_are_missing(self):
        self.refuse("it ends after 60 of the 61 rows", self.lines[:61] + [""])
        self.refuse("columns", self.lines[:30] +
                    [",".join(self.lines[30].split(",")[:-1])] + self.lines[31:])
        self.refuse("other columns", ["time [s]"] + self.lines[1:])
        self.refuse("other columns", [""])


class ChangedMesh(ProgramTest):
    """A checkpoint belongs to a mesh, not to the name of one."""

    PARAMETERS = ["Mesh/Degree=1", "Time/Final time=1", "Output/Checkpoint every=2",
                  "Output/Fields every=0"]

    def test_another_content(self):
        mesh = self.folder / "mesh.msh"
        text = (ROOT / "meshes" / "sphere_h4.msh").read_text()
        mesh.write_text(text)
        parameters = self.PARAMETERS + [f"Mesh/File={mesh}"]
        self.run_program("sphere", parameters)
        # Moved with the project, it is the same mesh still.
        moved = self.folder / "moved.msh"
        shutil.copy(mesh, moved)
        self.run_program("sphere", self.PARAMETERS + [f"Mesh/File={moved}"],
                         options=["--resume"])
        # One coordinate in another place.
        lines = text.split("\n")
        first = lines.index("$Nodes") + 2
        words = lines[first].split()
        words[1] = str(float(words[1]) * 1.0001 + 1e-6)
        lines[first] = " ".join(words)
        mesh.write_text("\n".join(lines))
        code, _, error = self.attempt("sphere", parameters, options=["--resume"])
        self.assertEqual(code, 1, msg=error)
        self.assertIn("belongs to a run with other parameters", error)
        self.assertIn("checksum", error)


if __name__ == "__main__":
    main()
