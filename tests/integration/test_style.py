# SPDX-License-Identifier: LGPL-2.1-or-later
"""The checks of style find deliberate errors in a small artificial tree."""

import importlib.util
import shlex

from common import *

sys.path.insert(0, str(ROOT / "doc"))

import check_spelling  # noqa: E402
import source_text  # noqa: E402

specification = importlib.util.spec_from_file_location("tidy", ROOT / "scripts" / "tidy.py")
tidy = importlib.util.module_from_spec(specification)
specification.loader.exec_module(tidy)

SOURCES = ["lib/a.cc", "lib/user.cc", "lib/other.cc"]


class Style(ProgramTest):
    def setUp(self):
        super().setUp()
        for folder in tidy.FOLDERS + ("scripts",):
            (self.folder / folder).mkdir()
        self.write("lib/a.h", "using A = int;\n")
        self.write("lib/a.cc", '#include "a.h"\n')
        self.write("lib/alone.h", "using B = int;\n")
        self.write("lib/user.cc", "#include <lib/alone.h>\n")
        self.write("lib/other.cc", "using C = int;\n")

    def write(self, path, text):
        (self.folder / path).write_text(text)

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *words],
                       cwd=self.folder, check=True, capture_output=True)

    def format(self, *words):
        for name in (".clang-format", "scripts/format.sh"):
            shutil.copy(ROOT / name, self.folder / name)
        result = subprocess.run(["bash", "scripts/format.sh", *words], cwd=self.folder,
                                capture_output=True, text=True)
        if result.returncode == 77:
            self.skipTest("no clang-format 14")
        return result

    def test_format(self):
        """Unformatted files are named, with the command; and then formatted."""
        self.assertEqual(self.format().returncode, 0)
        self.write("examples/ugly.h", "using  B=int ;\n")
        result = self.format()
        self.assertEqual(result.returncode, 1)
        self.assertIn("examples/ugly.h:1", result.stderr)
        self.assertIn("scripts/format.sh --fix", result.stderr)
        self.assertEqual(self.format("--fix").returncode, 0)
        self.assertEqual(self.format().returncode, 0)

    def test_changed_files(self):
        """Files of the last commit and of the working tree, or of all commits that upstream
        lacks."""
        self.assertIsNone(tidy.changed_files(self.folder))  # no git
        self.git("init", "-b", "main")
        self.assertEqual(tidy.changed_files(self.folder),
                         ["lib/a.cc", "lib/a.h", "lib/alone.h", "lib/other.cc",
                          "lib/user.cc"])  # no commit
        self.git("add", ".")
        self.git("commit", "-m", "first")
        self.assertEqual(tidy.changed_files(self.folder), [])  # nothing before it
        self.git("branch", "upstream")
        for name in ("a", "other"):
            self.write(f"lib/{name}.cc", "using D = int;\n")
            self.git("commit", "-am", name)
        self.write("lib/new.h", "")
        self.assertEqual(tidy.changed_files(self.folder), ["lib/new.h", "lib/other.cc"])
        self.git("branch", "--set-upstream-to", "upstream")
        self.assertEqual(tidy.changed_files(self.folder),
                         ["lib/a.cc", "lib/new.h", "lib/other.cc"])

    def test_headers_are_seen_within_a_source(self):
        """The source of their name, or the first one that includes them."""
        def chosen(*changed):
            return tidy.to_check(self.folder, SOURCES, list(changed))

        self.assertEqual(chosen("lib/a.h"), ["lib/a.cc"])
        self.assertEqual(chosen("lib/alone.h"), ["lib/user.cc"])
        self.assertEqual(chosen("lib/alone.h", "lib/user.cc"), ["lib/user.cc"])
        self.assertEqual(chosen("lib/gone.cc", "README.md", "lib/nobody.h"), [])

    def test_commands(self):
        """Only flags that affect parsing are passed on, and only for our own sources."""
        entries = [{"directory": "/b", "file": str(self.folder / path), "command": shlex.join(
            ["c++", "-DNAME=\"x y\"", "-I/lib", "-isystem", "/their", "-include", "pch.hxx",
             "-mmove-max=256", "-mavx2", "-std=c++17", "-O2", "-Werror"])}
                   for path in ("lib/a.cc", "build/pch.cxx")]
        commands = tidy.commands_for_clang(entries, self.folder)
        self.assertEqual([entry["file"] for entry in commands], [entries[0]["file"]])
        self.assertEqual(commands[0]["arguments"],
                         ["clang++", "-DNAME=\"x y\"", "-I/lib", "-isystem", "/their",
                          "-mavx2", "-std=c++17", "-w", "-c", entries[0]["file"]])

    def test_findings(self):
        """A finding in a header of ours is reported; one in a header of others is not."""
        program = tidy.clang_tidy()
        if program is None:
            self.skipTest("no clang-tidy")
        shutil.copy(ROOT / ".clang-tidy", self.folder)
        (self.folder / "their").mkdir()
        overriding = ("struct {0} {{ virtual void f(); }};\n"
                      "struct {1} : {0} {{ virtual void f(); }};\n")
        self.write("their/their.h", overriding.format("A", "B"))
        self.write("lib/a.h", "#include <their.h>\n")

        def check():
            commands = [{"directory": str(self.folder), "file": str(self.folder / "lib/a.cc"),
                         "command": f"c++ -isystem {self.folder}/their "
                                    f"-I{self.folder}/lib -c lib/a.cc"}]
            (self.folder / "compile_commands.json").write_text(
                tidy.json.dumps(tidy.commands_for_clang(commands, self.folder)))
            return tidy.check(program, self.folder, self.folder, "lib/a.cc")

        is_clean, text = check()
        self.assertTrue(is_clean, msg=text)
        self.assertEqual(text, "")
        self.write("lib/a.h", overriding.format("C", "D"))
        is_clean, text = check()
        self.assertFalse(is_clean)
        self.assertIn("modernize-use-override", text)
        self.assertIn("lib/a.h:2", text)


# A sentence for each idiom of doc/idioms.txt, in order; sentences without any.
WRONG = [
    "A ball falls before a rigid plane.",
    "Points before the facets have a gap.",
    "Dimension of the space: 2 or 3.",
    "The scene is in the plane.",
    "Two spheres collide in space.",
    "The gap is exact, but for round-off.",
    "The work is told twice.",
    "Stick and slip are told apart by a trial.",
    "The balance does not tell whether it is right.",
    "The work is force times way of the belt.",
    "A point passes a vertex, by the part of its way on each facet.",
    "The energy is three times its start on the way.",
    "Each node is held off the facets.",
    "The ring feels itself.",
    "Points go to and fro over a vertex.",
    "Parts that hang together are one.",
    "A law knows nothing of the scheme.",
    "What contact makes of its energy is in the table.",
    "A multiplier is in the place of the stress.",
    "The new file takes the place of the old one.",
    "A law of one's own has a file.",
    "The parameter steers Newton's method.",
    "The table of energies has a row for each step.",
    "A row of the ledger.",
    "Write a file every so many steps.",
    "Cut faces is there in 2D only.",
    "What sticks does not creep.",
    "A file sets only what differs.",
    "The work is what is stored.",
    "What falls has no equilibrium.",
    "The mass stays what it is.",
    "A checkpoint is written by the clock.",
    "Which is which is found by active sets.",
    "A damaged mesh ends in a sentence.",
    "A method to get rid of vibrations.",
]
BEGINNINGS = ["What a run leaves.", "Those of the step.", "Of each contact.", "The same of a step."]
RIGHT = [
    "The energy before the impact, and the mean before the last step.",
    "The slip is in the plane of the facet, and in the plane x = 0.",
    "Discretisation in space and time.",
    "Not the gap is zero, but for a moment its rate.",
    "By the way, the bar flies to and fro in this way, one way or the other.",
    "Errors tell the user what to do, and the place of the facet is known.",
    "The impact takes place at once.",
    "So many facets that each has a group; the file is there.",
]


class Idioms(ProgramTest):
    """Comments and pages say the words of the field."""

    def check(self, *words):
        return subprocess.run([sys.executable, ROOT / "doc" / "check_spelling.py", "--sources",
                               *words], capture_output=True, text=True)

    def test_sources(self):
        result = self.check()
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        self.assertRegex(result.stdout, r"^[1-9]\d\d+ source files, 0 idioms")

    def test_each_idiom_is_found(self):
        expressions = [expression for expression, _ in check_spelling.idioms()]
        self.assertEqual(len(expressions), len(WRONG + BEGINNINGS))
        for expression, sentence in zip(expressions, WRONG + BEGINNINGS):
            with self.subTest(sentence):
                self.assertRegex(sentence, expression)
                self.assertTrue(check_spelling.findings(sentence, True) +
                                check_spelling.findings(sentence, False))
        for sentence in RIGHT + BEGINNINGS:
            with self.subTest(sentence):
                self.assertEqual(check_spelling.findings(sentence, is_comment=False), [])

    def test_wrong_sentences_in_files(self):
        """Found across the lines of a comment and in messages of the library, not in code."""
        (self.folder / "lib" / "base").mkdir(parents=True)
        files = {
            "lib/base/a.h": '/**\n * It is exact, but\n * for round-off.\n */\n'
                            'const char *b = "but for the //";\n// A ball before\n// a plane.\n',
            "lib/base/a.py": '"""One.\n\nParts that hang\ntogether.\n"""\nA = "of one\'s own"\n'
                             "B = A  # What it is.\n",
            "README.md": "Exact.\n\n- in\n  space\n\n```\nheld off\n```\n",
            "CHANGELOG.md": "Before a plane.\n",
        }
        for name, text in files.items():
            (self.folder / name).write_text(text)
        result = self.check(self.folder)
        self.assertEqual(result.returncode, 1)
        places = [line.split(": ")[0] for line in result.stderr.splitlines()]
        self.assertEqual(places, ["README.md:3", "lib/base/a.h:2", "lib/base/a.h:5",
                                  "lib/base/a.h:6", "lib/base/a.py:3", "lib/base/a.py:7"], msg=result.stderr)
        self.assertIn("except for", result.stderr)

    def test_paragraphs(self):
        self.assertEqual(source_text.paragraphs(["a", " b ", "", "- c", "- d", "  e"]),
                         [(0, "a b"), (3, "- c"), (4, "- d e")])


if __name__ == "__main__":
    main()
