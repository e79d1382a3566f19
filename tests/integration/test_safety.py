# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing is lost and nothing silently replaced: full disks, folders that are in
use or hold another run, damaged tables, meshes that changed."""

import random
import re
import resource
import signal
import struct
import time
import zlib

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
        """All files are complete, except for the end of energy tables."""
        for file in run.rglob("*"):
            if file.suffix == ".vtu":
                self.assertTrue(file.read_text().rstrip().endswith("</VTKFile>"),
                                msg=file)
            if file.suffix == ".h5":
                self.assertEqual(file.read_bytes()[:8], b"\x89HDF\r\n\x1a\n")
            if file.suffix == ".pvd":
                ends = file.read_text().rstrip()
                self.assertTrue(ends.endswith("</VTKFile>"), msg=file)
            self.assertNotEqual(file.suffix, ".unfinished", msg=file)

    def test_programs_that_start_at_once_share_no_folder(self):
        """One that ended removed files that another had just begun to use: now they need no folder
        of temporary files, and start without one."""
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
        and its checkpoint and energy table are there."""
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
        # Also when another file's run replaces it, and when the values of a
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
        """Fields of an earlier run are removed; lost ones are not listed."""
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


class Signals(ProgramTest):
    """Ctrl-C, and the signal by which batch systems announce their end."""

    # More than a second, in steps of a millisecond.
    LONG = ["Time/Final time=60", "Output/Log every=0"]

    def start(self, parameters=LONG, folder=None, ignored=None, **kwargs):
        """Start a run and wait until it has made some steps."""
        folder = folder or self.folder / "run"
        table = folder / "energy.csv"
        n_rows = lambda: table.read_bytes().count(b"\n") if table.exists() else 0
        n_before = n_rows()
        process = subprocess.Popen(
            self.command("bar_sd", parameters, folder, **kwargs), cwd=ROOT,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            preexec_fn=lambda: ignored and signal.signal(ignored, signal.SIG_IGN))
        self.addCleanup(process.kill)
        while n_rows() < n_before + 20:
            self.assertIsNone(process.poll())
            time.sleep(.002)
        return process

    def test_the_step_is_finished_and_the_run_goes_on_later(self):
        """The table is that of a run without a stop, digit for digit."""
        whole, run = self.folder / "whole", self.folder / "run"
        self.run_program("bar_sd", self.LONG, whole)
        options = []
        for number, name, code in ((signal.SIGINT, "SIGINT", 130),
                                   (signal.SIGTERM, "SIGTERM", 143)):
            process = self.start(options=options)
            process.send_signal(number)
            _, error = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code, msg=error)
            self.assertIn("stopped by a signal", error)
            self.assertIn(name + " came in step", error)
            self.assertIn("--resume", error)
            for file in ("checkpoint.bin", "energy.h5"):
                self.assertTrue((run / file).exists(), msg=file)
            self.assertIn("largest balance residual", (run / "log.txt").read_text())
            options = ["--resume"]
        n_rows = len(Ledger(run)["time"])
        self.assertLess(n_rows, len(Ledger(whole)["time"]))
        # A run is not lost because --resume was forgotten.
        table = (run / "energy.csv").read_bytes()
        code, _, error = self.attempt("bar_sd", self.LONG)
        self.assertEqual(code, 1, msg=error)
        self.assertIn("--resume", error)
        self.assertEqual((run / "energy.csv").read_bytes(), table)
        self.run_program("bar_sd", self.LONG, options=["--resume"])
        self.assertEqual((run / "energy.csv").read_bytes(),
                         (whole / "energy.csv").read_bytes())

    def test_a_rank_gets_it(self):
        process = self.start(n_ranks=2)
        ranks = subprocess.run(["pgrep", "-P", str(process.pid)],
                               capture_output=True, text=True).stdout.split()
        self.assertEqual(len(ranks), 2)
        os.kill(int(ranks[1]), signal.SIGTERM)
        _, error = process.communicate(timeout=60)
        self.assertIn("SIGTERM came in step", error)
        self.assertEqual(process.returncode, 143, msg=error)
        self.assertTrue((self.folder / "run" / "checkpoint.bin").exists())

    def test_the_second_one_ends_it_at_once(self):
        """Steps of some tenths of a second, in which both come."""
        process = subprocess.Popen(
            self.command("elastic_ball",
                         ["Mesh/Nodes=40000", "Mesh/Boundary nodes=800",
                          "Output/Checkpoint every=1"]),
            cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        checkpoint = self.folder / "run" / "checkpoint.bin"
        while not checkpoint.exists():
            self.assertIsNone(process.poll())
            time.sleep(.01)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertIn(process.returncode, (-signal.SIGINT, -signal.SIGTERM))
        self.assertTrue(checkpoint.exists())

    def test_what_was_ignored_at_the_start_is_ignored(self):
        """As with nohup, or behind an & in a script."""
        process = self.start(ignored=signal.SIGINT)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, msg=error)

    def test_checkpoints_by_the_clock(self):
        whole, run = self.folder / "whole", self.folder / "run"
        parameters = self.LONG + ["Output/Checkpoint every minutes=0.0005"]
        self.run_program("bar_sd", self.LONG, whole)
        self.assertFalse((whole / "checkpoint.bin").exists())
        for n_ranks in (1, 2):
            process = self.start(parameters, folder=run / str(n_ranks), n_ranks=n_ranks)
            while not (run / str(n_ranks) / "checkpoint.bin").exists():
                self.assertIsNone(process.poll())
                time.sleep(.002)
            process.kill()
            process.communicate(timeout=60)
        self.run_program("bar_sd", self.LONG, run / "1", options=["--resume"])
        self.assertEqual((run / "1" / "energy.csv").read_bytes(),
                         (whole / "energy.csv").read_bytes())


class FilesOfOthers(ProgramTest):
    """Files that are not of a run stay as they are."""

    def setUp(self):
        if is_debug_build():
            self.skipTest("files are the same with assertions")
        super().setUp()

    def refuse(self, text, *args, **kwargs):
        code, _, error = self.attempt(*args, **kwargs)
        self.assertEqual(code, 1, msg=error)
        self.assertIn(text, " ".join(error.split()))

    def test_fields_that_a_run_has_not_written(self):
        run = self.folder / "run"
        fields = run / "solution"
        fields.mkdir(parents=True)
        mine = fields / "step-by-step.txt"
        mine.write_text("mine")
        self.refuse("'solution'", "bar_sd", SHORT)
        mine.rename(self.folder / "mine")
        for _ in range(2):
            self.run_program("bar_sd", SHORT + ["Output/Fields every=20"])
            (self.folder / "mine").replace(mine)
            self.assertEqual(len(list(fields.glob("*.vtu"))), 4)
            shutil.copy(mine, self.folder / "mine")
        self.run_program("bar_sd", SHORT + NO_FIELDS)
        self.assertEqual(list(fields.iterdir()), [mine])

    def test_a_parameter_file_with_the_name_of_a_result(self):
        run = self.folder / "run"
        run.mkdir()
        text = "# my notes\nsubsection Time\n set Final time = 1\nend\n"
        for name in ("parameters.prm", "run.txt", "log.txt"):
            (run / name).write_text(text)
            self.refuse("has the name of a file that the run writes", "bar_sd",
                        prm=run / name, options=["--overwrite"])
            self.assertEqual((run / name).read_text(), text)
            (run / name).unlink()
        # From elsewhere it is read, and the values have the name.
        given = self.folder / "parameters.prm"
        given.write_text(text)
        (run / ".lock").unlink()
        self.run_program("bar_sd", prm=given)
        self.assertIn("set Final time", (run / "parameters.prm").read_text())
        self.assertEqual(given.read_text(), text)

    def test_another_file_of_the_same_name_in_the_folder(self):
        run = self.folder / "run"
        run.mkdir()
        (run / "case.prm").write_text("# mine\n")
        given = self.folder / "case.prm"
        given.write_text("subsection Time\n set Final time = 1\nend\n")
        self.refuse("'case.prm' is not the file that was given", "bar_sd", prm=given)
        self.assertEqual((run / "case.prm").read_text(), "# mine\n")

    def test_a_resume_of_nothing_leaves_nothing(self):
        self.refuse("does not exist", "bar_sd", options=["--resume"])
        self.assertFalse((self.folder / "run").exists())

    def test_a_run_that_was_extended(self):
        run = self.folder / "run"
        self.run_program("bar_sd", SHORT)
        self.run_program("bar_sd", SHORT + ["Time/Final time=5"], options=["--resume"])
        table = (run / "energy.csv").read_bytes()
        self.refuse("was resumed and has a checkpoint", "bar_sd", SHORT)
        self.assertEqual((run / "energy.csv").read_bytes(), table)
        self.run_program("bar_sd", SHORT)
        # At its end, without more, it may be made again.
        code, _, error = self.attempt("bar_sd", SHORT)
        self.assertEqual(code, 0, msg=error)

    def test_pictures_of_a_scene(self):
        scene = ROOT / "parameter_files" / "ricochet" / "hyperelastic_ring.prm"
        for name in ("setup.vtk", "setup.txt", "setup_obstacles.vtu"):
            other = self.folder / name / name
            other.parent.mkdir()
            other.write_text("mine")
            self.refuse("is not of Ricochet", "ricochet", prm=scene,
                        folder=other.parent, options=["--validate"])
            self.assertEqual(other.read_text(), "mine")
        for _ in range(2):
            code, _, error = self.attempt("ricochet", prm=scene, options=["--validate"])
            self.assertEqual(code, 0, msg=error)


class StrangeCheckpoint(ProgramTest):
    """A checkpoint with a good checksum and unknown contents."""

    def test_random_payload(self):
        random.seed(1)
        run = self.folder / "run"
        self.run_program("bar_sd", SHORT)
        whole = (run / "checkpoint.bin").read_bytes()
        head = whole.index(b"\n") + 1
        payload = whole[head + 12:]

        def resume(bytes_of_payload):
            (run / "checkpoint.bin").write_bytes(
                whole[:head] + struct.pack("<QI", len(bytes_of_payload),
                                           zlib.crc32(bytes_of_payload)) +
                bytes_of_payload)
            return self.attempt("bar_sd", SHORT, options=["--resume"])
        self.assertEqual(resume(payload)[0], 0)
        some = [random.randbytes(len(payload)), b"", payload[:-8]]
        for _ in range(6):
            changed = bytearray(payload)
            for place in random.choices(range(len(payload)), k=20):
                changed[place] = random.randrange(256)
            some.append(bytes(changed))
        for content in some:
            code, _, error = resume(content)
            self.assertIn(code, (1, 2), msg=error)
            self.assertNotIn("should not happen", error)


class LittleMemory(ProgramTest):

    def test_the_end_is_reached(self):
        """OpenBLAS waited for threads that it had no memory for, when all was done."""
        if is_debug_build():
            self.skipTest("takes more memory with assertions")
        environment = {name: value for name, value in os.environ.items()
                       if "_NUM_THREADS" not in name}
        codes = []
        for megabytes in (530, 600, 1000):
            size = megabytes << 20
            result = subprocess.run(
                self.command("bar_sd", SHORT, self.folder / f"{size}"), cwd=ROOT,
                env=environment, capture_output=True, text=True, timeout=60,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
            codes.append(result.returncode)
        self.assertEqual(codes[-1], 0, msg=result.stderr)
        self.assertTrue(set(codes) <= {0, 2}, msg=codes)


class DamagedTable(ProgramTest):
    """--resume does not trust energy.csv. Each test damages a copy of the same
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
        # One coordinate is changed.
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

    def test_a_geometry_that_is_included(self):
        """The parameter file and the geometry are the same, but not the mesh."""
        (self.folder / "size.geo").write_text("height = 1;\n")
        (self.folder / "body.geo").write_text(
            'Include "size.geo";\n'
            "Point(1) = {0, 0, 0, .5}; Point(2) = {1, 0, 0, .5};\n"
            "Point(3) = {1, height, 0, .5}; Point(4) = {0, height, 0, .5};\n"
            "For i In {1:4}\n Line(i) = {i, i % 4 + 1};\nEndFor\n"
            "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\n"
            'Physical Curve("floor", 1) = {1}; Physical Surface("all", 2) = {1};\n')
        scene = self.folder / "scene.prm"
        scene.write_text("""
set Dimension = 2
subsection Body block
  set File = body.geo
  set Velocity = 0, -1
end
subsection Time
  set Time step  = 1e-3
  set Final time = 2e-3
end
subsection Output
  set Checkpoint every = 1
end
""")
        self.run_program("ricochet", prm=scene)
        self.run_program("ricochet", ["Time/Final time=3e-3"], prm=scene,
                         options=["--resume"])
        (self.folder / "size.geo").write_text("height = 1.01;\n")
        # The run goes on with the mesh that it was begun with.
        self.run_program("ricochet", ["Time/Final time=4e-3"], prm=scene,
                         options=["--resume"])
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertIn("the mesh of 'block' is the one of mesh_of_block.msh", log)
        (self.folder / "run" / "mesh_of_block.msh").unlink()
        log = (self.folder / "run" / "log.txt").read_text()
        code, _, error = self.attempt("ricochet", ["Time/Final time=5e-3"], prm=scene,
                                      options=["--resume"])
        self.assertEqual(code, 1, msg=error)
        self.assertIn("belongs to another mesh", " ".join(error.split()))
        self.assertEqual((self.folder / "run" / "log.txt").read_text(), log)

    def test_a_geometry_with_rounded_edges(self):
        """Gmsh makes another mesh of it in each process, as sets of addresses have another order: ranks
        and a run that is resumed have one mesh."""
        (self.folder / "box.geo").write_text(
            'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 0.1, 0.08, 0.06};\n'
            "Fillet{1}{1 : 12}{0.015}\nMesh.MeshSizeMin = 0.01;\nMesh.MeshSizeMax = 0.02;\n")
        scene = self.folder / "scene.prm"
        scene.write_text("""
set Dimension = 3
subsection Body box
  set File     = box.geo
  set Velocity = 0, 0, -1
end
subsection Time
  set Time step  = 1e-3
  set Final time = 4e-3
end
subsection Output
  set Checkpoint every = 1
end
subsection Linear solver
  set Distribute = true
end
""")
        for n in range(2):
            part = self.folder / f"part_{n}"
            self.run_program("ricochet", ["Time/Final time=2e-3"], part, prm=scene, n_ranks=2)
            ledger = self.run_program("ricochet", (), part, prm=scene, options=["--resume"])
            self.assertEqual(len(ledger["time"]), 5)
            for energy in ledger["energy"]:
                self.assertAlmostEqual(energy / ledger["energy"][0], 1., places=12)


if __name__ == "__main__":
    main()
