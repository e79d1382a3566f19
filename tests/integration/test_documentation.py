# SPDX-License-Identifier: LGPL-2.1-or-later
"""The site's pages are complete: each step, parameter, column and field is documented."""

import re
import sys

from common import *

sys.path.insert(0, str(ROOT / "doc"))

import check_links  # noqa: E402
import check_spelling  # noqa: E402
import check_width  # noqa: E402
from generate import (
    examples,
    figures,
    methods,
    parameters,
    references,
    results,
    site,
    steps,
    text,
)  # noqa: E402

# A scene with all that adds columns: two bodies, two contacts, each kind of probe.
SCENE = """
set Program = ricochet
set Dimension = 2
subsection Body ball
  set Shape = disk
  set Radius = 0.5
  set Nodes around = 16
  set Translation = 0.02, 0.01
  set Velocity = 0, -3
end
subsection Body brick
  set Shape = rectangle
  set Size = 2, 0.5
  set Cells along = 4, 2
  set Translation = -1, -1
end
subsection Obstacle floor
  set Centre = 0, -1.01
end
subsection Contact below
  set Surface = ball
  set Against = floor
  set Treatment = penalty
end
subsection Contact between
  set Surface = ball
  set Against = brick: upper
  set Treatment = improved normal compliance
end
subsection Condition side
  set Boundary = brick: lower
end
subsection Probe middle
  set Body = ball
end
subsection Probe speed
  set Body = ball
  set Quantity = velocity
end
subsection Probe change
  set Body = ball
  set Quantity = acceleration
end
subsection Probe squeeze
  set Body = ball
  set Quantity = stress
end
subsection Probe turn
  set Body = ball
  set Quantity = rotation
end
subsection Probe hold
  set Body = brick: lower
  set Quantity = force
end
subsection Probe push
  set Body = brick: lower
  set Quantity = impulse
end
subsection Time
  set Time step = 5e-3
  set Final time = 0.02
end
"""

SCENE_IN_SPACE = """
set Program = ricochet
set Dimension = 3
subsection Body box
  set Shape = block
  set Size = 1, 1, 1
  set Cells along = 1, 1, 1
end
subsection Obstacle floor
  set Centre = 0, 0, -0.5
  set Direction = 0, 0, 1
end
subsection Contact below
  set Surface = box
  set Against = floor
end
subsection Probe turn
  set Body = box
  set Quantity = rotation
end
subsection Time
  set Time step = 1e-3
  set Final time = 2e-3
end
"""

# Short runs that together have all columns and fields.
RUNS = [
    ("bar_sd", None, ["Time/Final time=0.1"]),
    ("bar_ss", None, ["Time/Final time=0.1"]),
    ("elastic_ball", None, ["Mesh/Nodes=392", "Mesh/Boundary nodes=64", "Time/Final time=0.002"]),
    ("obstacle_course", "drum", ["Time/Final time=0.01"]),
    ("sphere", None, ["Time/Final time=0.25", "Mesh/Mesh size=10"]),
    ("stent_artery", "default", ["Time/Final time=0.02"]),
    ("colliding_disks", "default", ["Time/Final time=0.008"]),
    ("colliding_spheres", None, ["Time/Final time=0.004"]),
    ("colliding_tori", None, ["Time/Final time=0.004"]),
    ("sliding_block", "default", ["Time/Final time=0.004"]),
]


def folder_of_programs():
    return pathlib.Path(program_path("bar_sd")).parent


class Pages(unittest.TestCase):
    def test_a_program_is_split_without_loss(self):
        for name in site.steps():
            with self.subTest(name):
                step = steps.read(name)
                self.assertGreater(len(step.introduction), 200)
                self.assertTrue(any(not block.is_prose for block in step.blocks))
                page = steps.program_text(step)
                lines = steps.source(name).read_text().splitlines()
                code = [
                    line.strip()
                    for line in lines
                    if line.strip() and not re.match(r"\s*//(?!/)", line)
                ]
                position = 0
                for line in code:
                    position = page.index(line, position)

    def test_comments_within_expressions_stay_code(self):
        blocks = steps.blocks_of(
            [
                "// Prose",
                "f(1,",
                "  // one",
                "  // two",
                "  2);",
                "  // a",
                "",
                "  // b",
                "  // c",
                "/// For Doxygen.",
                "int a;",
            ]
        )
        self.assertEqual([block.is_prose for block in blocks], [True, False, True, False])
        self.assertEqual(blocks[2].lines, ["b", "c"])

    def test_prose_keeps_templates_and_formulas(self):
        self.assertEqual(
            text.prose(["A `Body<dim>` and a Body<dim>, $0 <x$"]),
            "A `Body<dim>` and a Body\\<dim>, $0 <x$",
        )

    def test_what_is_included_is_there(self):
        for path in [
            *(ROOT / "doc/how_to").glob("*.md"),
            *(ROOT / "doc").glob("*.md"),
            *(ROOT / "doc/results").glob("*.md"),
            *(ROOT / "doc/methods").glob("*.md"),
            *(ROOT / "doc/tutorials").glob("*.md"),
        ]:
            with self.subTest(path.name):
                page = path.relative_to(ROOT / "doc").with_suffix("").as_posix()
                self.assertNotIn("<!-- include", text.with_includes(path.read_text(), page))
        with self.assertRaises(site.SiteError):
            text.with_includes("<!-- include: README.md # No such heading -->", "x")

    def test_exercises_belong_to_steps(self):
        for path in (ROOT / "doc/tutorials").glob("*.md"):
            with self.subTest(path.stem):
                self.assertIn(path.stem, site.steps())
                results, exercises = steps._own_text(steps.read(path.stem))
                self.assertGreater(len(results) + len(exercises), 0.9 * path.stat().st_size - 200)

    def test_figures(self):
        entries = figures.load()
        self.assertGreater(len(entries), 50)
        for entry in entries:
            with self.subTest(entry.name):
                self.assertGreater(len(entry.figure.title), 5)
                self.assertGreater(len(entry.figure.caption), 30)
                self.assertTrue(set(entry.programs) <= set(site.steps()), entry.programs)
                for run in entry.figure.runs:
                    if run.parameter_file:
                        self.assertTrue((ROOT / "parameter_files" / run.parameter_file).is_file())

    def test_examples_have_a_row_and_a_picture(self):
        folder = ROOT / "examples"
        rows = examples._rows((folder / "README.md").read_text())
        for path in folder.glob("*.prm"):
            with self.subTest(path.stem):
                self.assertIn(path.stem, rows)
                self.assertTrue((folder / "images" / f"{path.stem}.png").is_file())
                self.assertGreater(len(examples.head_of(path)), 100)


class Parameters(unittest.TestCase):
    def test_each_parameter_has_a_text(self):
        programs = folder_of_programs()
        with ThreadPoolExecutor(max_workers=2) as pool:
            lists = list(pool.map(lambda name: parameters.declared(programs / name), site.steps()))
        for name, found in zip(site.steps(), lists):
            with self.subTest(name):
                self.assertGreater(len(found), 5)
                self.assertEqual(len({each.name for each in found}), len(found))
                for each in found:
                    self.assertGreater(len(each.meaning), 10, each.name)
                    self.assertRegex(each.meaning, r"[.)]$", each.name)
        sections = {each.section for each in lists[site.steps().index("ricochet")]}
        for kind in ("Body", "Material", "Obstacle", "Contact", "Condition", "Probe"):
            self.assertIn(f"{kind} NAME", sections)

    def test_what_is_allowed(self):
        programs = folder_of_programs()
        of_bar = {each.name: each for each in parameters.declared(programs / "bar_sd")}
        self.assertEqual(of_bar["Time/Time step"].allowed, "a number above 0")
        self.assertIn("penalty", of_bar["Contact/Treatment"].allowed)
        for name, words in (
            ("Output/Checkpoint every", "a whole number, at least 0"),
            ("Time/HHT alpha", "a number from −1/3 to 1/3"),
            ("Newton/Tolerance", "a number from 10⁻¹⁵ to 10⁻⁶"),
            ("Output/Fields at", "numbers, separated by commas"),
            ("Output/Folder", "a folder"),
            ("Output/Timing", "true or false"),
        ):
            self.assertEqual(of_bar[name].allowed, words)
        self.assertTrue(of_bar["Time/Mass"].allowed.startswith("one of: consistent, "))
        of_sphere = {each.name: each for each in parameters.declared(programs / "sphere")}
        self.assertEqual(
            of_sphere["Start/Initial velocity"].allowed, "3 numbers, separated by commas"
        )
        # Parameters of ricochet in both dimensions.
        of_scenes = {each.name: each for each in parameters.declared(programs / "ricochet")}
        self.assertEqual(of_scenes["Body NAME/Rotation axis"].only, "3D")
        self.assertEqual(of_scenes["Body NAME/Nodes around"].only, "2D")
        self.assertIn("ball, block", of_scenes["Body NAME/Shape"].allowed_in_space)
        self.assertEqual(of_scenes["Body NAME/Size"].default_in_space, "1, 1, 1")
        self.assertIsNone(of_scenes["Body NAME/Density"].allowed_in_space)
        # Neither the words of deal.II nor the numbers of compilers.
        for each in [*of_bar.values(), *of_sphere.values()]:
            self.assertNotRegex(each.allowed, "MAX|2147483647|4294967295|such that")

    def test_what_a_program_prints(self):
        printed = "# Listing of Parameters\n# ---------------------\n# One\n# text.\nset A = 1\n"
        printed += "\n\nsubsection B\n  # Another (m).\n  set C d = \nend\n"
        printed += "\n# What is allowed:\n#   B/C d: A whole number\n"
        self.assertEqual(
            parameters.parse(printed),
            [
                parameters.Parameter("A", "One text.", "1"),
                parameters.Parameter("B/C d", "Another (m).", "", "a whole number"),
            ],
        )

    def test_units(self):
        for meaning, unit in (
            ("Length (m).", "m"),
            ("See (paper A, (2.10)), c (Pa/m^(alpha-1)).", "Pa/m^(alpha-1)"),
            ("A number (see above).", ""),
            ("Density (kg/m^3).", "kg/m^3"),
        ):
            self.assertEqual(parameters.unit_of(meaning), unit)

    def test_files_that_set_a_parameter(self):
        of_bar = {(each.path, each.name): each.value for each in parameters.settings_of("bar_sd")}
        file = "parameter_files/bar_sd/default.prm"
        self.assertEqual(of_bar[file, "Time/Scheme"], "Crank-Nicolson")
        sections = {"Body NAME", "Time"}
        self.assertEqual(parameters.general_name("Body ball/Radius", sections), "Body NAME/Radius")
        self.assertEqual(parameters.general_name("Time/Scheme", sections), "Time/Scheme")


class Methods(unittest.TestCase):
    def test_each_method_has_a_page(self):
        names = methods.choices(folder_of_programs())
        self.assertIn("persistent contact", names["treatment"])
        self.assertIn("TR-BDF2", names["scheme"])
        pages = methods.pages(names)
        if not pages:
            self.skipTest("there are no pages of methods yet")
        told = {name for page in pages for name in page.names}
        for kind, list_ in names.items():
            for name in set(list_) - {"none"}:
                with self.subTest(kind=kind, name=name):
                    self.assertIn(name, told)
        for page in pages:
            with self.subTest(page.title):
                self.assertTrue(set(page.names) <= set().union(*names.values()), page.names)
                self.assertGreater(len(page.conserves), 5)
                self.assertTrue(page.source)
                for file in page.source:
                    self.assertTrue((ROOT / file).is_file(), file)


class Literature(unittest.TestCase):
    def test_entries_are_complete_and_cited(self):
        entries = references.entries()
        bib = (ROOT / "doc/references.bib").read_text()
        self.assertEqual(len(entries), bib.count("\n@"), "an entry is not as the others")
        for key, pages in references.citing_pages().items():
            with self.subTest(key):
                self.assertIn(key, entries, pages)
                self.assertTrue(pages, "no page cites it")
                self.assertIn(entries[key]["keywords"], references.GROUPS)
                if entries[key].authors and entries[key]["journal"] and not entries[key]["url"]:
                    for name in ("year", "volume", "pages"):
                        self.assertTrue(entries[key][name], name)

    def test_citations_have_the_labels_of_their_entries(self):
        for path in (ROOT / "doc").rglob("*.md"):
            for label, key in references.cited(path.read_text()):
                with self.subTest(page=path.name, key=key):
                    self.assertEqual(label, references.entries()[key].label)

    def test_page_of_the_literature_is_of_its_file(self):
        self.assertEqual(references.PAGE.read_text(), references.page(),
                         "run python3 -m generate.references in doc/")

    def test_a_page_gets_its_list(self):
        page = references.with_references("See [Yeoh 1993](../literature.md#yeoh1993).", "methods/x")
        self.assertIn('href="../literature.html#yeoh1993">Yeoh 1993</a>', page)
        self.assertIn('<a href="https://doi.org/10.5254/1.3538343">', page)
        self.assertEqual(page.count("<li>"), 1)
        self.assertEqual(references.with_references("Nothing.", "x"), "Nothing.")


class Results(ProgramTest):
    def test_columns_and_fields(self):
        """Columns and fields of the programs are documented, and documented ones are written."""
        (self.folder / "scene.prm").write_text(SCENE)
        (self.folder / "in_space.prm").write_text(SCENE_IN_SPACE)
        cases = [
            (program, ROOT / f"parameter_files/{program}/{file}.prm" if file else None, values)
            for program, file, values in RUNS
        ]
        cases.append(("ricochet", self.folder / "scene.prm", []))
        cases.append(("ricochet", self.folder / "in_space.prm", []))

        def run(numbered):
            number, (program, prm, values) = numbered
            folder = self.folder / f"run-{number}"
            ledger = self.run_program(program, [*values, "Output/Fields every=1"], folder, prm=prm)
            names = set()
            for path in folder.glob("solution/*.vtu"):
                head = path.read_bytes()
                names |= {
                    name.decode() for name in re.findall(rb'<DataArray [^>]*Name="([^"]+)"', head)
                }
            return program, dict(zip(ledger.names, ledger.units)), names, folder

        columns, fields = results.read("columns"), results.read("fields")
        seen = set()
        with ThreadPoolExecutor(max_workers=2) as pool:
            for program, units, names, folder in pool.map(run, enumerate(cases)):
                for name, unit in units.items():
                    with self.subTest(program=program, column=name):
                        item = results.find(columns, name)
                        self.assertIsNotNone(item, "not in doc/results/columns.toml")
                        seen.add(item.name)
                        self.assertEqual(item.unit, unit)
                for name in names - {"connectivity", "offsets", "types", "TIME"}:
                    with self.subTest(program=program, field=name):
                        item = results.find(fields, name)
                        self.assertIsNotNone(item, "not in doc/results/fields.toml")
                        seen.add(item.name)
                heads = re.search(r"^ *step/of .*$", (folder / "log.txt").read_text(), re.MULTILINE)
                words = re.findall(r"(\S+)(?: \[(.*?)\])?", heads[0])
                items = results.read("console")
                self.assertEqual([word for word, _ in words], [item.name for item in items])
                self.assertEqual([bool(unit) for _, unit in words],
                                 [bool(item.unit) for item in items])
        for item in columns + fields:
            with self.subTest(item.name):
                self.assertIn(item.name, seen, "no program writes it")


class Checkers(ProgramTest):
    def test_broken_links_are_found(self):
        (self.folder / "a.html").write_text(
            '<a href="b.html#here">x</a><a href="b.html#there">x</a><img src="c.png">'
            '<a href="https://example.org/none">x</a>'
        )
        (self.folder / "b.html").write_text('<p id="here">x</p>')
        count, broken = check_links.broken_links(self.folder)
        self.assertEqual(count, 3)
        self.assertEqual(len(broken), 2, broken)

    @unittest.skipUnless(check_width.BROWSER, "there is no browser (Debian's chromium)")
    def test_wide_formulas_are_found(self):
        box = '<div class="math" style="width: {}px; overflow-x: auto"><p style="width: 300px">x'
        for name, width in (("fits", 320), ("scrolls", 200), ("wide", 500)):
            (self.folder / f"{name}.html").write_text(
                "<!DOCTYPE html><body style='margin: 0'>" + box.format(width))
        pages = check_width.pages_with_formulas(self.folder)
        self.assertEqual([(page, excess) for page, excess, _ in sorted(
            check_width.too_wide(self.folder, pages, 400))], [("scrolls.html", 100), ("wide.html", 100)])

    @unittest.skipUnless(shutil.which("aspell"), "aspell is not installed")
    def test_misspelt_words_are_found(self):
        self.assertEqual(
            check_spelling.unknown("The colour of a contakt in my_file.prm"), {"contakt"}
        )

    def test_words_are_in_order(self):
        lines = (ROOT / "doc/words.txt").read_text().split("\n\n")
        for part in lines:
            words = [line for line in part.splitlines() if not line.startswith("#")]
            self.assertEqual(words, sorted(set(words), key=str.lower))


if __name__ == "__main__":
    main()
