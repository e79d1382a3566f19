# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of strangers: results that the Python package reads, and tables and variables that the
program ricochet reads. Each is refused by a sentence, and none ends the interpreter."""

import html
import json
import random
import re
import resource
import time
import unittest.mock

from common import *

PACKAGE = ROOT / "python"
sys.path.insert(0, str(PACKAGE))

try:
    import numpy
    import ricochet
    from ricochet import fields, hdf5, page, plot_command, prm, results
except ImportError:
    numpy = None
try:
    import h5py
except ImportError:
    h5py = None
try:
    import vtk
except ImportError:
    vtk = None

SCENE = """set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape       = rectangle
  set Size        = {size}
  set Cells along = 4, 2
  set Velocity    = 0, -0.5
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface = block: lower
  set Against = floor
end
subsection Condition pull
  set Boundary = block: upper
  set Kind     = traction
  set {load}
end
subsection Time
  set Final time = 0.004
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 2
end
{more}"""


def scene(size="0.2, 0.1", load="Value = 0; 0", more=""):
    return SCENE.format(size=size, load=load, more=more)


@unittest.skipIf(numpy is None, "NumPy or matplotlib (Debian's python3-matplotlib) is missing")
class HostileResults(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="ricochet-"))
        cls.addClassCleanup(shutil.rmtree, cls.shared, ignore_errors=True)
        (cls.shared / "scene.prm").write_text(scene())
        cls.good = ricochet.run(program_path("ricochet"), cls.shared / "scene.prm",
                                output=cls.shared / "run")

    def setUp(self):
        super().setUp()
        self.run_folder = self.folder / "copy"
        shutil.copytree(self.good.folder, self.run_folder)

    def refused(self, action, sentence="."):
        with self.assertRaises(ricochet.RicochetError) as caught:
            action()
        self.assertRegex(str(caught.exception), sentence)
        self.assertLess(len(str(caught.exception)), 1000)

    def write(self, name, data):
        path = self.run_folder / name
        path.unlink(missing_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    # The table

    @unittest.skipIf(h5py is None, "h5py (Debian's python3-h5py) is missing")
    def test_energy_of_hdf5(self):
        """Values and units are those of energy.csv, to the last digit."""
        (self.run_folder / "energy.csv").unlink()
        run = ricochet.Run(self.run_folder)
        self.assertEqual(set(run.table.columns), set(self.good.table.columns))
        for name, values in self.good.table.columns.items():
            self.assertEqual(run.table[name].tobytes(), values.tobytes(), msg=name)
        self.assertEqual(dict(run.units), dict(self.good.units))
        self.assertEqual(run.summary().energy_lost, self.good.summary().energy_lost)
        (self.run_folder / "parameters.prm").unlink()
        self.assertEqual(len(ricochet.Run(self.run_folder).table), len(self.good.table))

    @unittest.skipIf(h5py is None, "h5py (Debian's python3-h5py) is missing")
    def test_damaged_hdf5(self):
        path = self.run_folder / "energy.h5"
        data = path.read_bytes()
        (self.run_folder / "energy.csv").unlink()

        def refuse(sentence="damaged or is none of ours|no energy table"):
            self.refused(lambda: ricochet.Run(self.run_folder).table, sentence)

        for text in (b"", data[:3000], b"\x89HDF\r\n\x1a\n" + b"\0" * 4096):
            self.write("energy.h5", text)
            refuse()
        # A library that crashes, and one that does not come to an end.
        reader = self.folder / "reader.py"
        for text in ("import os\nos.kill(os.getpid(), 11)\n", "import time\ntime.sleep(60)\n"):
            reader.write_text(text)
            with unittest.mock.patch.multiple(hdf5, READER=reader, LONGEST=2.0):
                refuse()

        def make(fill):
            path.unlink()
            with h5py.File(path, "w") as file:
                for name in ("time", "energy"):
                    file.create_dataset(name, data=numpy.zeros(3)).attrs["unit"] = "1"
                fill(file)
            return refuse

        secret = self.folder / "secret.h5"
        with h5py.File(secret, "w") as file:
            file.create_dataset("x", data=numpy.zeros(3)).attrs["unit"] = "1"

        def outside(file):
            space = file.create_dataset("x", (3,), "f8", external=[(str(secret), 0, 24)])
            space.attrs["unit"] = "1"

        def link(file):
            file["x"] = h5py.ExternalLink(str(secret), "x")

        def giant(file):
            column = file.create_dataset("x", (10 ** 12,), "f8", chunks=(1000,))
            column.attrs["unit"] = "1"

        def table(file):
            file.create_dataset("x", data=numpy.zeros((3, 3))).attrs["unit"] = "1"

        def other_length(file):
            file.create_dataset("x", data=numpy.zeros(4)).attrs["unit"] = "1"

        def no_unit(file):
            file.create_dataset("x", data=numpy.zeros(3))

        for fill in (outside, link, giant, table, other_length, no_unit):
            with self.subTest(fill.__name__):
                make(fill)()
        make(lambda file: file.__delitem__("energy"))("no columns 'time' and 'energy'")

    def test_energy_of_csv(self):
        for text, sentence in (
                ("", "is empty"), ("\0\n", "no columns 'time' and 'energy'"),
                (b"\xff\xfe\n", "cannot be read"), ("time [s],energy [J]\n", "no rows"),
                ("a" * 200000 + "\n1\n", "cannot be read: field larger"),
                ("time [s],energy [J]\n1\n", "1 cells in row 1"),
                ("time [s],energy [J]\nnan,1\n", "not finite"),
                ("time [s],energy [J]\n1,0x1\n", "not a number"),
                ("time [s]" + ",a" * 10 ** 5 + "\n1,2\n", "2 cells in row 1")):
            with self.subTest(text[:40]):
                self.write("energy.csv", text)
                self.refused(lambda: ricochet.Run(self.run_folder).table, sentence)
        (self.run_folder / "energy.csv").unlink()
        os.mkfifo(self.run_folder / "energy.csv")
        self.refused(lambda: ricochet.Run(self.run_folder).table, "no regular file")
        # Names are shown as they are, in pictures too.
        self.write("energy.csv", "time [$t$],energy [$\\frac$],contact_force_$\\frac{$ [$N$],"
                   "penetration_$\\frac{$ [$m$]\n0,1,nan,0\n1,1e308,inf,0\n")
        run = ricochet.Run(self.run_folder)
        for path in plot_command.plot([run], self.folder / "plots"):
            self.assertTrue(path.exists())

    def test_tables_changed_at_random(self):
        rows = (self.run_folder / "energy.csv").read_text().split("\n")
        generator = random.Random(1)
        n_read = 0
        for _ in range(300):
            lines = list(rows)
            for _ in range(generator.choice([1, 5])):
                k = generator.randrange(len(lines) - 1)
                cells = lines[k].split(",")
                cells[generator.randrange(len(cells))] = generator.choice(
                    ["nan", "-inf", "1e308", "", "9" * 400, "x [m]", "contact_force_ [N]", "1,2"])
                lines[k] = ",".join(cells)
            self.write("energy.csv", "\n".join(lines))
            try:
                with numpy.errstate(all="ignore"):
                    str(ricochet.Run(self.run_folder).summary())
                n_read += 1
            except ricochet.RicochetError:
                pass
        self.assertGreater(n_read, 20)

    # Texts

    def test_summaries(self):
        found = json.loads((self.run_folder / "summary.json").read_text())
        outcome = ricochet.Outcome("a", {"A/B": 1}, None, None, 0.)
        for change in ({"checks": 3}, {"contacts": {"a": []}}, {"energy": None},
                       {"checks": {"balance": []}}, {"contacts": {"a": {"largest_force": 1}}}):
            with self.subTest(change):
                self.write("summary.json", json.dumps({**found, **change}))
                run = ricochet.Run(self.run_folder)
                self.refused(lambda: ricochet.frame([ricochet.Outcome(
                    "a", {}, run, None, 0.)]), "is damaged")
        self.assertEqual(ricochet.sampling.row({"A/B": 1}, outcome)["state"], "failed")
        for text in ("9" * 5000, '{"format": 1' + "," * 10, "\ufeff{}", b"\xff"):
            self.write("summary.json", text)
            self.refused(lambda: ricochet.Run(self.run_folder).result, "summary")
        with open(self.run_folder / "summary.json", "wb") as file:
            file.truncate(1 << 40)
        self.refused(lambda: ricochet.Run(self.run_folder).result, "larger than")

    def test_parameters(self):
        read = lambda: ricochet.Run(self.run_folder).parameters
        for text, sentence in (
                ("subsection a\n" * 11, "sections in each other"),
                (f"subsection {'a' * 5000}\nend\n", "more than 1000 letters"),
                ("include /dev/zero\n", "no regular file"),
                ("include ../copy/parameters.prm\n", "includes itself"),
                ("set x\n", "cannot make sense"), (b"\xff\n", "cannot be read"),
                ("#" * (1 << 24) + "\n\n", "larger than")):
            with self.subTest(text[:40]):
                self.write("parameters.prm", text)
                self.refused(read, sentence)
        # Their time grows with the length of the file only.
        begin = time.monotonic()
        self.write("parameters.prm", "set x = \\\n" + "a\\\n" * 500000 + "b\n" +
                   "".join(f"subsection s{k}\nend\n" for k in range(30000)))
        self.assertEqual(len(read()["x"]), 500001)
        self.assertLess(time.monotonic() - begin, 20)

    def test_names_of_programs(self):
        """The name of a program in a stranger's run may be given to `run`, and is none of others."""
        for name in ("/bin/sh", "../x", "./sh", "sh -c", "-v", ""):
            with self.subTest(name):
                self.write("run.txt", f"program = {name}\n")
                self.write("parameters.prm", f"set Program = {name}\n")
                self.refused(lambda: ricochet.Run(self.run_folder).program, "program")
        self.write("run.txt", "program = sh\n")
        name = ricochet.Run(self.run_folder).program
        self.write("evil.prm", f"touch {self.folder}/was_run\n")
        named = os.environ.pop("RICOCHET_PROGRAMS", None)
        if named:
            self.addCleanup(os.environ.__setitem__, "RICOCHET_PROGRAMS", named)
        self.refused(lambda: ricochet.run(name, self.run_folder / "evil.prm"), "no program")
        for name in ("/bin/sh", "../x", "sh", "bash"):
            self.write("evil.prm", f"set Program = {name}\n")
            self.refused(lambda: ricochet.dataset(self.run_folder / "evil.prm", {"A/B": (1, 2)}, 1,
                                                  1, output=self.folder / "set"), "no program of")
        self.assertFalse((self.folder / "was_run").exists())
        # A folder that has no name.
        self.write("evil.prm", "subsection Output\n set Folder = /\nend\n")
        default = ricochet.programs.default_output("bar_sd", self.run_folder / "evil.prm")
        self.assertEqual(str(default), "/")

    # Fields

    def test_lists_of_fields(self):
        entry = '<VTKFile><Collection><DataSet timestep="{}" file="{}"/></Collection></VTKFile>'
        bomb = ('<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">' + "".join(
            f'<!ENTITY {b} "{("&" + a + ";") * 10}">' for a, b in zip("abcdefgh", "bcdefghi"))
            + ']><a>&i;</a>')
        for text, sentence in (
                ("", "cannot be read"), ("<a>", "cannot be read"), ("<a/>", "is empty"),
                (bomb, "document type"),
                ('<!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>', "document type"),
                ('<?xml version="1.0" encoding="no-such"?><a/>', "is empty"),
                ("<DataSet/>", "without 'timestep'"),
                (entry.format("0", "/etc/passwd"), "in the folder of the run"),
                (entry.format("0", "../run/solution/step-000000.vtu"), "in the folder of the run"),
                (entry.format("0", "solution/../../x.vtu"), "in the folder of the run"),
                (entry.format("nan", "x.vtu"), "times are finite"),
                (entry.format("zero", "x.vtu"), "cannot be read")):
            with self.subTest(text[:60]):
                self.write("solution.pvd", text)
                self.refused(lambda: ricochet.Run(self.run_folder).steps, sentence)
        self.write("solution.pvd", entry.format("0", "solution/step-" + "9" * 5000 + ".vtu"))
        self.assertEqual(len(ricochet.Run(self.run_folder).steps), 1)
        self.write("solution.pvd", entry.format("0", ""))
        if vtk is not None:
            self.refused(ricochet.Run(self.run_folder).fields, "damaged|no file of fields")

    @unittest.skipIf(vtk is None, "VTK (Debian's python3-vtk9) is missing")
    def test_grids_are_those_of_vtk(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        many = self.folder / "ranks"
        self.run_program("ricochet", folder=many, prm=self.shared / "scene.prm", n_ranks=2)
        for run in (self.good, ricochet.Run(many)):
            reader = vtk.vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(run.field_file().path))
            reader.Update()
            theirs, ours = reader.GetOutput(), run.fields()
            for get in (lambda g: g.GetPoints().GetData(), lambda g: g.GetCellTypesArray(),
                        lambda g: g.GetCells().GetConnectivityArray(),
                        lambda g: g.GetCells().GetOffsetsArray()):
                self.assertTrue(numpy.array_equal(*(vtk_to_numpy(get(g)) for g in (theirs, ours))))
            self.assertEqual(*(g.GetPointData().GetNumberOfArrays() for g in (theirs, ours)))
            for k in range(ours.GetPointData().GetNumberOfArrays()):
                name = ours.GetPointData().GetArrayName(k)
                self.assertTrue(numpy.array_equal(
                    *(vtk_to_numpy(g.GetPointData().GetArray(name)) for g in (theirs, ours))))

    @unittest.skipIf(vtk is None, "VTK (Debian's python3-vtk9) is missing")
    def test_damaged_fields(self):
        path = ricochet.Run(self.run_folder).field_file().path
        text = path.read_text()
        name = str(path.relative_to(self.run_folder))
        for old, new, sentence in (
                ('NumberOfPoints="32"', 'NumberOfPoints="1000000000000"', "fewer values"),
                ('NumberOfPoints="32"', 'NumberOfPoints="-1"', "negative"),
                ('NumberOfPoints="32"', 'NumberOfPoints="16"', "more values"),
                ('NumberOfCells="8"', 'NumberOfCells="0"', "."),
                ('NumberOfComponents="9"', 'NumberOfComponents="999999999"', "fewer values"),
                ('"UInt8"', '"Float32"', "fractions"), ('"Int32"', '"Int64"', "fewer values"),
                ('"LittleEndian"', '"BigEndian"', "no unstructured grid"),
                ('format="binary"', 'format="appended"', "neither text nor binary"),
                ("AQAAA", "/////", "header is longer"), ("eN", "!!", "base64"),
                ("<VTKFile", '<!DOCTYPE a [<!ENTITY a "b">]><VTKFile', "document type")):
            with self.subTest(new):
                self.assertIn(old, text)
                self.write(name, text.replace(old, new))
                self.refused(lambda: results.read_fields(path), sentence)
        # Corners and types that do not exist, in an array that is whole.
        for new in ("0 1 2 99", "0 1 2 -1", "0 1 2 3"):
            kind = "9" if "99" in new or "-1" in new else "200"
            self.write(name, '<VTKFile type="UnstructuredGrid" byte_order="LittleEndian">'
                       '<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray '
                       'type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 '
                       '0</DataArray></Points><Cells>'
                       + "".join(f'<DataArray type="Int32" Name="{what}" format="ascii">{values}'
                                 "</DataArray>" for what, values in (
                                     ("connectivity", new), ("offsets", "4"), ("types", kind)))
                       + "</Cells></Piece></VTKFile>")
            self.refused(lambda: results.read_fields(path), "does not exist|unknown")
        # Changed at random: numbers or a sentence.
        generator = random.Random(3)
        for _ in range(300):
            data = bytearray(text.encode())
            for _ in range(generator.choice([1, 3])):
                data[generator.randrange(len(data))] = generator.randrange(256)
            self.write(name, bytes(data[:generator.choice([None, generator.randrange(len(data))])]))
            try:
                grid = results.read_fields(path)
                fields.values(grid, "stress")
                page.surface_of(grid)
            except ricochet.RicochetError:
                pass

    @unittest.skipIf(vtk is None, "VTK (Debian's python3-vtk9) is missing")
    def test_markup_in_a_page(self):
        """Names are texts, whatever they look like."""
        evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>@DATA@"
        folder = self.folder / evil.replace("/", "")
        shutil.copytree(self.run_folder, folder)
        table = (folder / "energy.csv").read_text()
        (folder / "energy.csv").write_text(
            table.replace("_floor [", f"_{evil} [").replace("time [s]", f"time [{evil}]"))
        # A contact with a force, which is drawn.
        rows = (folder / "energy.csv").read_text().split("\n")
        column = [cell.split(" [")[0] for cell in rows[0].split(",")].index(f"contact_force_{evil}")
        cells = rows[2].split(",")
        cells[column] = "1"
        rows[2] = ",".join(cells)
        (folder / "energy.csv").write_text("\n".join(rows))
        run = ricochet.Run(folder)
        self.assertEqual(run.contacts, [evil])
        path = page.write(run, self.folder / "run.html", "von_mises", [(0, 0, 0)] * 256, 3)
        text = path.read_text()
        self.assertEqual(len(re.findall("<script", text)), 2)
        self.assertEqual(len(re.findall("</script", text)), 2)
        self.assertNotIn("<img", text)
        data = re.search(r'<script id="data"[^>]*>(.*?)</script>', text, re.DOTALL)[1]
        self.assertIn(evil, [line["name"] for plot in json.loads(data)["curves"]["plots"]
                             for line in plot["lines"]])
        self.assertIn(f"<title>ricochet: {html.escape(folder.name)}</title>", text)

    # Set-ups

    def test_set_ups(self):
        folder = self.folder / "setup"
        code, _, error = self.attempt("ricochet", folder=folder, prm=self.shared / "scene.prm",
                                      options=["--validate"])
        self.assertEqual(code, 0, msg=error)
        from ricochet import setup_picture
        text = (folder / "setup.vtk").read_text()
        setup_picture.read(folder)
        for old, new in (("CELLS", "CELL"), ("\n4 ", "\n4000 "), ("\n4 0", "\n4 999999"),
                         ("\n4 0", "\n4 -5"), ("\n0 ", "\nnan ")):
            with self.subTest(new):
                self.assertIn(old, text)
                (folder / "setup.vtk").write_text(text.replace(old, new))
                self.refused(lambda: setup_picture.read(folder), "set-up")


class HostileInput(ProgramTest):
    """The program ricochet with tables and variables: exit code 1, and a sentence."""

    def validate(self, text, code=1, sentence=""):
        file = self.folder / "scene.prm"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        memory = 4 << 30
        begin = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run(
            [program_path("ricochet"), str(file), "--output-dir", str(self.folder / "run"),
             "--overwrite", "--quiet"], capture_output=True, text=True, errors="replace",
            timeout=60, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory)))
        self.assertEqual(result.returncode, code, msg=result.stderr[:500])
        if code:
            self.assertIn("the input is not valid", result.stderr)
        self.assertLess(len(result.stderr), 3000)
        self.assertIn(sentence, " ".join(result.stderr.split()))
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime, 5)

    def test_tables(self):
        for text, code, sentence in (
                (b"t,v\r\n0,0\r\n1,1\r\n", 0, ""), (b"\xef\xbb\xbft,v\n0,0\n1,1", 0, ""),
                (b"", 1, "fewer than two rows"), (b"\0" * 1000, 1, "fewer than two rows"),
                # Neither a number that ends at a zero byte, nor a first row that is none.
                (b"t,v\n0,0\n1,\x001\n", 1, "line 3 should have a time"),
                (b"0,nan\n1,1\n2,1\n", 1, "line 1 should have a time"),
                (b"\xef\xbb\xbf0,0\n1,1", 0, ""),
                (b"t,v\n0,nan\n1,1\n", 1, "should have a time"),
                (b"t,v\n0,0\n1,1e999\n", 1, "should have a time"),
                (b"0,0\n0,1\n", 1, "times have to grow"),
                (b"0,0\n1,1,2\n", 1, "another number of values"),
                (b"0" + b",1" * 10 ** 6 + b"\n1" + b",1" * 10 ** 6 + b"\n", 1, "1000000 values"),
                ("t,v\n0,0\n1,1\n".encode("utf-16"), 1, "cannot be read")):
            with self.subTest(text[:20]):
                (self.folder / "pull.csv").write_bytes(text)
                self.validate(scene(load="Table = pull.csv"), code, sentence)
        (self.folder / "pull.csv").unlink()
        self.validate(scene(load="Table = pull.csv"), 1, "No such file")
        self.validate(scene(load="Table = /dev/zero"), 1, "larger than")

    def test_names(self):
        """A name of a section that is in the path of each of its parameters."""
        self.validate(f"subsection {'a' * 6_000_000}\n" + 400_000 * "set a = 1\n" + "end\n", 1,
                      "the name of the section has 6000000 characters; there may be 200")

    def test_braces(self):
        for text, sentence in (
                ("{{w}}", "a brace is alone"),
                ("{" * 10000 + "w" + "}" * 10000, "a brace is alone"),
                ("{}", "cannot be read"), ("{x}", "no variable 'x'"), ("{w/0}", "not finite")):
            with self.subTest(text[:20]):
                self.validate(scene(f"{text}, 0.1", more="subsection Variables\nset w = 1\nend\n"),
                              1, sentence)

    def test_variables(self):
        for text, sentence in (
                ("set w = a\nset a = b\nset b = w", "needs itself"), ("set w = 0/0", "not finite"),
                ("set w = inf", "no variable 'inf'"), ("set w = 0.\0002", "cannot be read"),
                ("set w = " + "(" * 1000, "cannot be read"),
                ("set w = 1" + "+1" * 16000, "32001 characters; there may be 2000"),
                ("set w = " + "(" * 10 ** 5, "100000 characters"),
                ("set \u00fc = 1", "cannot be the name"),
                ("".join(f"set w{k} = w{k + 1}\n" for k in range(200)) + "set w200 = 1",
                 "more than 100 variables")):
            with self.subTest(text[:20]):
                self.validate(scene("{w}, 0.1", more=f"subsection Variables\n{text}\nend\n"), 1,
                              sentence)
        good = scene("{w}, 0.1", more="subsection Variables\nset w = a90*2^-89\n" + "".join(
            f"set a{k} = a{k - 1}+a{k - 1}\n" for k in range(1, 91)) + "set a0 = 0.1\nend")
        for text in (good.replace("\n", "\r\n"), "\ufeff" + good):
            self.validate(text, 0)


if __name__ == "__main__":
    main()
