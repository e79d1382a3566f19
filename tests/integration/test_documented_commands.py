# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands in the introductions of the programs and in the documentation work."""

import re
import shlex

from common import *


def commands_in(file, prefix):
    """Command lines of our programs that stand alone on a line of @p file."""
    programs = [folder.name for folder in (ROOT / "steps").iterdir()]
    for line in file.read_text().splitlines():
        match = re.match(rf"{prefix}((?:build/release/)?({'|'.join(programs)})"
                         r"(?: .*)?)$", line)
        if match:
            yield shlex.split(match.group(1).replace("build/release/", ""))


# Long runs are cut short: the test is on the command line.
SHORTENED = {"elastic_ball": "Time/Final time=0.01",
             "hyperelastic_ring": "Time/Final time=0.05",
             "sphere": "Time/Final time=1",
             "obstacle_course": "Time/Final time=0.05",
             "colliding_disks": "Time/Final time=0.05",
             "colliding_spheres": "Time/Final time=0.012",
             "colliding_tori": "Time/Final time=0.008",
             "stent_artery": "Time/Final time=0.3",
             "sliding_block": "Time/Final time=0.1"}


class DocumentedCommands(ProgramTest):

    def check(self, commands):
        commands = list(commands)
        self.assertGreater(len(commands), 2)
        for words in commands:
            with self.subTest(" ".join(words)):
                if words[0] in SHORTENED and len(words) > 1:
                    words += ["--set", SHORTENED[words[0]]]
                words[0] = program_path(words[0])
                # All of them write to one folder.
                words += ["--overwrite"]
                if "--output-dir" not in words and "--help" not in words:
                    words += ["--output-dir", str(self.folder / "run")]
                elif "--output-dir" in words:
                    words[words.index("--output-dir") + 1] = str(
                        self.folder / "run")
                result = subprocess.run(words, cwd=ROOT, capture_output=True,
                                        text=True, timeout=600)
                self.assertEqual(result.returncode, 0, msg=result.stderr)

    def test_introductions_of_the_steps(self):
        self.check(command for file in sorted((ROOT / "steps").glob("*/*.cc"))
                   for command in commands_in(file, "//     "))

    def test_readme(self):
        self.check([words for file in ("README.md", "doc/how_to/run.md")
                    for words in commands_in(ROOT / file, "")])

    def test_scene_of_the_documentation(self):
        """The scene in "how to", by the commands below it."""
        page = ROOT / "doc" / "how_to" / "scenes.md"
        text = page.read_text()
        scene = next(block for block in re.findall(r"```\n(.*?)```", text, re.DOTALL)
                     if block.startswith("set Program   = ricochet"))
        file = self.folder / "mine.prm"
        file.write_text(scene)
        self.check([[str(file) if word == "mine.prm" else word for word in words]
                    for words in commands_in(page, "")])
        ledger = Ledger(self.folder / "run")
        self.assertGreater(max(ledger["contact_force_on_the_floor"]), 1e3)
        self.assertGreater(max(ledger["contact_force_ball_and_brick"]), 1e3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-10)

    def files_of_short_figures(self):
        sys.path.insert(0, str(ROOT / "figures"))
        try:
            from shared import finding
        except ImportError:
            return set()
        return {ROOT / "parameter_files" / run.parameter_file
                for figure in finding.find().values() if figure.is_short
                for run in figure.runs}

    def test_all_parameter_files_are_valid(self):
        """Files of the short figures are run by these, in a test of their own."""
        files = sorted(set((ROOT / "parameter_files").glob("*/*.prm")) -
                       self.files_of_short_figures())
        self.assertGreater(len(files), 20)
        with ThreadPoolExecutor(max_workers=2) as pool:
            results = pool.map(lambda file: self.attempt(
                file.parent.name, prm=file, options=["--validate"],
                folder=self.folder / file.parent.name / file.stem), files)
            for file, (code, _, error) in zip(files, results):
                with self.subTest(file.name):
                    self.assertEqual(code, 0, msg=error)


if __name__ == "__main__":
    main()
