# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scripts read: parameters as a JSON Schema, --validate and refusals as JSON.

The bounds are those that the program itself enforces: each is tried from both sides."""

import json
import re

from common import *

SCENE = """
set Program   = ricochet
set Dimension = 2
subsection Body ball
  set Shape  = disk
  set Radius = 0.5
end
subsection Obstacle floor
  set Shape  = half space
  set Centre = 0, -0.6
end
subsection Contact floor
  set Surface              = ball
  set Against              = floor
  set Friction coefficient = 0.2
end
subsection Time
  set Final time = 0.01
  set Time step  = 0.005
end
"""


class MachineInterface(ProgramTest):
    def schema(self, program, parameters=()):
        code, out, err = self.attempt(program, parameters,
                                      options=["--print-parameters", "--json"])
        self.assertEqual((code, err), (0, ""))
        return json.loads(out)

    def refusal(self, text="", parameters=(), options=("--validate",), code=1, **kwargs):
        file = self.folder / "scene.prm"
        file.write_text(text or SCENE)
        found, out, err = self.attempt("ricochet", parameters, prm=file,
                                       options=[*options, "--json"], **kwargs)
        self.assertEqual(found, code, msg=out + err)
        answer = json.loads(err)
        self.assertEqual(answer["exit"], code)
        self.assertEqual(set(answer),
                         {"code", "exit", "file", "line", "key", "nearest", "sentence"})
        return answer

    def test_schema_of_parameters(self):
        """Every parameter that the text has is there, with a type; defaults are within the
        bounds."""
        def leaves(schema):
            for part in ("properties", "patternProperties"):
                for name, member in schema.get(part, {}).items():
                    if "properties" in member:
                        for key, value in member["properties"].items():
                            yield f"{name}/{key}", value
                    else:
                        yield name, member

        for program in ("bar_sd", "elastic_ball", "ricochet"):
            schema = self.schema(program)
            for dimension, own in ((2, schema.get("else", schema)), (3, schema.get("then", schema))):
                parameters = [f"Dimension={dimension}"] if program == "ricochet" else []
                _, text, _ = self.attempt(program, parameters, options=["--print-parameters"])
                known = len(re.findall(r"^ *set ", text, re.MULTILINE))
                found = dict(leaves(own))
                self.assertEqual(len(found), known)
                for name, member in found.items():
                    self.assertTrue("type" in member or "enum" in member, msg=name)
                    self.assertTrue(member["description"], msg=name)
                    default = member["default"]
                    if "enum" in member:
                        self.assertIn(default, member["enum"], msg=name)
                    elif member["type"] in ("number", "integer"):
                        self.assertGreaterEqual(default, member.get("minimum", default), msg=name)
                        self.assertLessEqual(default, member.get("maximum", default), msg=name)
                    elif member["type"] == "array":
                        self.assertGreaterEqual(len(default), member.get("minItems", 0), msg=name)
                        self.assertLessEqual(len(default), member.get("maxItems", 99), msg=name)
        schema = self.schema("ricochet")
        in_space = schema["then"]["patternProperties"]["^Body .+$"]["properties"]
        self.assertEqual(in_space["Translation"]["minItems"], 3)
        self.assertIn("block", in_space["Shape"]["enum"])
        plane = schema["else"]["patternProperties"]["^Body .+$"]["properties"]
        self.assertEqual(plane["Translation"]["maxItems"], 2)
        self.assertEqual(plane["Density"]["exclusiveMinimum"], 0)
        for name, unit in (("Density", "kg/m^3"), ("Young modulus", "Pa"),
                           ("Viscosity eta", "Pa s"), ("Velocity", "m/s"),
                           ("Mass damping", "1/s")):
            self.assertEqual(plane[name]["unit"], unit)
        self.assertNotIn("unit", plane["Law"])
        self.assertNotIn("unit", plane["Poisson ratio"])

    def test_bounds_are_those_of_the_program(self):
        properties = self.schema("ricochet")["else"]["properties"]["Newton"]["properties"]
        for name, member in properties.items():
            if "minimum" in member:
                self.refusal(parameters=[f"Newton/{name}={member['minimum'] - 1}"])
            if "maximum" in member:
                answer = self.refusal(parameters=[f"Newton/{name}={member['maximum'] + 1}"])
                self.assertEqual((answer["code"], answer["key"]),
                                 ("value_not_allowed", f"Newton/{name}"))

    def test_answer_to_validate(self):
        file = self.folder / "scene.prm"
        file.write_text(SCENE)
        code, out, err = self.attempt("ricochet", prm=file, options=["--validate", "--json"])
        self.assertEqual((code, err), (0, ""))
        answer = json.loads(out)
        self.assertIs(answer["valid"], True)
        self.assertIn("Body ball", "\n".join(answer["phases"]["ricochet"]["lines"]))
        file.write_text(SCENE + "subsection Phase fall\nend\nsubsection Phase rest\nend\n")
        _, out, _ = self.attempt("ricochet", prm=file, options=["--validate", "--json"])
        self.assertEqual(list(json.loads(out)["phases"]), ["fall", "rest"])

    def test_refusals(self):
        """Kind, place, key and what may be meant, each by hand."""
        def line_of(text, word):
            return text[:text.index(word)].count("\n") + 1

        wrong = SCENE.replace("set Radius", "set Raduis")
        answer = self.refusal(wrong)
        self.assertEqual(answer["code"], "unknown_parameter")
        self.assertEqual(answer["key"], "Body ball/Raduis")
        self.assertEqual(answer["nearest"][0], "Body ball/Radius")
        self.assertEqual(answer["file"], str(self.folder / "scene.prm"))
        self.assertEqual(answer["line"], line_of(wrong, "Raduis"))
        self.assertIn("there is no parameter", answer["sentence"])
        wrong = SCENE.replace("subsection Obstacle", "subsection Obstakle")
        answer = self.refusal(wrong)
        self.assertEqual((answer["code"], answer["nearest"]),
                         ("unknown_section", ["Obstacle floor"]))
        self.assertEqual(answer["line"], line_of(wrong, "Obstakle"))
        answer = self.refusal(SCENE.replace("= ball", "= bal"))
        self.assertEqual((answer["code"], answer["key"], answer["nearest"]),
                         ("unknown_name", "bal", ["ball"]))
        for text, parameters, options, code in (
                ("nonsense\n", [], [], "syntax"),
                ("subsection A\n", [], [], "syntax"),
                (SCENE.replace("= ricochet", "= sphere"), [], [], "wrong_program"),
                ("include nowhere.prm\n", [], [], "unreadable_file"),
                ("", ["Contact floor/Nitsche theta=0"], [], "no_effect"),
                ("", [], ["--validat"], "unknown_option"),
                ("", ["Time/Time step=1"], [], "input")):
            with self.subTest(code):
                answer = self.refusal(text, parameters, ["--validate", *options])
                self.assertEqual(answer["code"], code)
        answer = self.refusal(SCENE + "subsection Phase fall\n  subsection Time\n    set Schem = x\n"
                              "  end\nend\n")
        self.assertEqual(answer["key"], "Time/Schem")
        self.assertEqual(answer["line"], SCENE.count("\n") + 3)

    def test_list_and_sections(self):
        """The list has each parameter once; a section is a part of all parameters."""
        code, text, _ = self.attempt("ricochet", options=["--list"])
        names = [line.split(" = ")[0] for line in text.splitlines()]
        _, whole, _ = self.attempt("ricochet", options=["--print-parameters"])
        self.assertEqual(code, 0)
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(len(names), len(re.findall(r"^ *set ", whole, re.MULTILINE)))
        self.assertRegex(text, r"(?m)^Time/Scheme = midpoint +\(Any one of .*BDF2")
        code, part, _ = self.attempt("ricochet", options=["--print-parameters", "Contact"])
        self.assertEqual(code, 0)
        block = part[:part.index("# What is allowed:")].strip()
        self.assertTrue(block.startswith("subsection Contact NAME\n"))
        self.assertTrue(block.endswith("\nend"))
        self.assertIn(block, whole)
        self.assertEqual(part.count("subsection"), 1)
        for line in part[part.index("# What is allowed:"):].splitlines()[1:]:
            self.assertTrue(line.startswith("#   Contact NAME/"))
        # A parameter file is no section.
        file = self.folder / "scene.prm"
        file.write_text(SCENE)
        _, of_scene, _ = self.attempt("ricochet", options=["--print-parameters", str(file)])
        self.assertIn("subsection Body ball", of_scene)
        answer = self.refusal(options=["--print-parameters", "Contct"], code=1)
        self.assertIn("neither a file nor a section", answer["sentence"])
        code, _, err = self.attempt("bar_sd", options=["--print-parameters", "Contct"])
        self.assertEqual(code, 1)
        self.assertIn("Is 'Contact' meant?", err)

    def test_progress(self):
        """A JSON object on each line and nothing else; its numbers are those of the table."""
        file = self.folder / "scene.prm"
        file.write_text(SCENE)
        code, out, err = self.attempt("ricochet", prm=file, options=["--progress", "json"])
        self.assertEqual((code, err), (0, ""))
        events = [json.loads(line) for line in out.splitlines()]
        self.assertEqual([event["event"] for event in events], ["begin", "step", "step", "end"])
        ledger = Ledger(self.folder / "run")
        for k, event in enumerate(events[1:3], 1):
            self.assertEqual((event["step"], event["of"]), (k, 2))
            for name in ("time", "energy", "newton_iterations", "balance_residual"):
                self.assertAlmostEqual(event[name], ledger[name][k], 12)
            self.assertEqual(event["contact_force"], ledger["contact_force_floor"][k])
        self.assertEqual(events[-1]["folder"], str(self.folder / "run"))
        code, _, err = self.attempt("bar_sd", options=["--progress", "xml"])
        self.assertEqual(code, 1)
        self.assertIn("takes json, not 'xml'", err)

    def test_help_manual_and_completion(self):
        """All of them have the same options; bash completes names after --set, with blanks."""
        texts = {}
        for option in ("--help", "--manual"):
            code, texts[option], err = self.attempt("ricochet", options=[option])
            self.assertEqual((code, err), (0, ""))
        options = re.findall(r"(?m)^  (--[a-z-]+)", texts["--help"])
        self.assertIn("--certify", options)
        for option in options:
            self.assertIn(f".B {option}".replace("-", "\\-"), texts["--manual"])
        for heading in ("EXAMPLES", "ENVIRONMENT", "EXIT STATUS"):
            self.assertIn(f".SH {heading}", texts["--manual"])
        for code in (0, 1, 2, 3, 4, 130):
            self.assertRegex(texts["--help"], rf"(?m)^  {code}\b")
        if shutil.which("man"):
            page = self.folder / "ricochet.1"
            page.write_text(texts["--manual"])
            shown = subprocess.run(["man", "--warnings", "-l", str(page)], capture_output=True,
                                   text=True, env={**os.environ, "MANPAGER": "cat"})
            self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        _, script, _ = self.attempt("bar_sd", options=["--completion", "bash"])
        (self.folder / "bash").write_text(script)

        def complete(*words):
            quoted = " ".join(f"'{word}'" for word in words)
            done = subprocess.run(
                ["bash", "-c", f"source {self.folder}/bash; COMP_WORDS=({quoted}); "
                 f"COMP_CWORD={len(words) - 1}; _ricochet_bar_sd; "
                 'printf "%s\\n" "${COMPREPLY[@]}"'],
                capture_output=True, text=True, cwd=self.folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return done.stdout.splitlines()

        self.assertEqual(complete("bar_sd", "--prog"), ["--progress"])
        self.assertEqual(complete("bar_sd", "--progress", ""), ["json"])
        self.assertEqual(complete("bar_sd", "--set", "Time/Time"), ["Time/Time\\ step="])
        self.assertEqual(complete("bar_sd", "--set", "Time/Time\\ s"), ["Time/Time\\ step="])
        self.assertEqual(complete("bar_sd", "--set", '"Time/Time s'), ["Time/Time step="])
        self.assertEqual(complete("bar_sd", "--print-parameters", "Lim"), ["Limits"])
        _, script, _ = self.attempt("bar_sd", options=["--completion", "zsh"])
        self.assertIn("'Time/Time step='", script)
        if shutil.which("zsh"):
            (self.folder / "zsh").write_text(script)
            self.assertEqual(subprocess.run(["zsh", "-n", self.folder / "zsh"]).returncode, 0)
        self.refusal(options=["--completion", "fish"])

    def test_script_of_the_documentation(self):
        """30 lines that need JSON alone: a misprint is corrected, two treatments are run."""
        code = re.search(r"```python\n(.*?)```", (ROOT / "doc/how_to/run.md").read_text(),
                         re.DOTALL).group(1)
        scene = next(block for block in re.findall(
            r"```\n(.*?)```", (ROOT / "doc/how_to/scenes.md").read_text(), re.DOTALL)
            if block.startswith("set Program   = ricochet"))
        (self.folder / "mine.prm").write_text(scene)
        self.assertIn("build/release/ricochet", code)
        script = self.folder / "study.py"
        script.write_text(code.replace("build/release/ricochet", program_path("ricochet")))
        result = subprocess.run([sys.executable, str(script)], capture_output=True, text=True,
                                cwd=self.folder, timeout=300)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual([line.split(" {")[0] for line in result.stdout.splitlines()],
                         ["persistent contact", "Signorini active set"])
        self.assertEqual(len(code.splitlines()), 30)

    def test_computation_that_stops(self):
        answer = self.refusal(
            parameters=["Body ball/Velocity=0, -30", "Time/Time step=0.01", "Time/Maximum halvings=0",
                        "Newton/Maximum iterations=1"],
            options=["--quiet"], code=2)
        self.assertEqual(answer["code"], "computation")


if __name__ == "__main__":
    main()
