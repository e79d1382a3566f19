# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 1: real parameter files, damaged."""

import shutil

from case import ANY, NOT_ACCEPTED
from programs import ALL, FILES, RUNS, parameters_of, printed_parameters, small

NO_NUMBERS = ["nan", "-nan", "NaN", "inf", "-inf", "Infinity", "1e400", "-1e400",
              "1e", "abc", "--5", "1;2", "0.1.2", "½", "٣", "\"0.1", "'0.1'",
              "0,1,", "1e5x", "$HOME", "`id`", "%s%n", "../../x", "9" * 5000,
              "x" * 100000, "\u202e1", "1 2 3", "1/2", "{}", "0.1\\"]
ODD_NUMBERS = ["1e308", "-1e308", "1.7976931348623157e308", "1e-320", "1e-30",
               "-1", "0", "-0", "0x10", "99999999999", "2147483647",
               "2147483648", "4294967296", "18446744073709551616", "1.5", "1e10",
               "1e-15", "", "+3", ".5", "5.", "1e+2", "007"]

ALIEN_TEXTS = [
    "import sys\nprint(sys.argv)\n",
    '{"Time": {"Time step": 0.1}}\n',
    '<?xml version="1.0"?>\n<VTKFile type="Collection"/>\n',
    "[Time]\nTime step = 0.1\n",
    "#!/bin/sh\nexit 0\n",
    "Time:\n  step: 0.1\n",
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
    "set\n", "subsection\n", "end\n", "include\n", "set = 1\n", "set x\n",
    "subsection \nend\n", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
]


def flatten(file):
    """The text of a file with its includes put in."""
    lines = []
    for line in file.read_text().splitlines():
        if line.startswith("include "):
            lines += flatten(file.parent / line.split()[1]).splitlines()
        else:
            lines.append(line)
    return "\n".join(lines) + "\n"


class Mutation:
    """Changes a text; says whether the result is invalid for sure."""

    def __init__(self, case, program, text):
        self.case, self.rng = case, case.rng
        self.lines = text.splitlines()
        self.text = text
        self.parameters = {p.name: p for p in parameters_of(case, program)}

    def where(self, keyword):
        """Numbers of the lines that begin so."""
        return [n for n, line in enumerate(self.lines)
                if line.split()[:1] == [keyword]]

    def joined(self):
        return "\n".join(self.lines) + "\n"

    def misspell(self, word):
        """One letter gone, doubled or wrong."""
        places = [k for k, c in enumerate(word) if c.isalnum()]
        k = self.rng.choice(places)
        return word[:k] + self.rng.choice(["", "q", word[k] * 2, "é"]) + word[k + 1:]

    def typo_in_name(self):
        n = self.rng.choice(self.where("set"))
        name, value = self.lines[n].strip()[4:].split("=", 1)
        self.lines[n] = f"  set {self.misspell(name.strip())} = {value}"
        return self.joined(), True

    def typo_in_section(self):
        n = self.rng.choice(self.where("subsection"))
        name = self.lines[n].split(None, 1)[1]
        self.lines[n] = "subsection " + self.misspell(name)
        # A section with nothing in it is harmless, whatever its name.
        following = next((line.split()[0] for line in self.lines[n + 1:]
                          if line.split() and line.strip()[0] != "#"), "end")
        return self.joined(), following == "set"

    def unbalanced(self):
        keyword = self.rng.choice(["end", "subsection"])
        n = self.rng.choice(self.where(keyword))
        if self.rng.random() < .5:
            del self.lines[n]
        else:
            self.lines.insert(n, self.lines[n])
        return self.joined(), True

    def value(self):
        """A value that is none, or an odd one."""
        section, places = None, []
        for n, line in enumerate(self.lines):
            words = line.split()
            if words[:1] == ["subsection"]:
                section = line.split(None, 1)[1]
            elif words[:1] == ["set"]:
                name = line.strip()[4:].split("=")[0].strip()
                places.append((n, name, f"{section}/{name}"))
        n, name, full = self.rng.choice(places)
        wrong = self.rng.random() < .5
        value = self.rng.choice(NO_NUMBERS if wrong else ODD_NUMBERS)
        self.lines[n] = f"  set {name} = {value}"
        parameter = self.parameters.get(full)
        is_text = parameter is None or parameter.type == "text"
        return self.joined(), wrong and not is_text

    def repeated_lines(self):
        n = self.rng.choice(self.where("set"))
        self.lines[n:n] = [self.lines[n]] * self.rng.choice([1, 10, 1000])
        return self.joined(), False

    def shuffled(self):
        self.rng.shuffle(self.lines)
        return self.joined(), False

    def strange_bytes(self):
        k = self.rng.randrange(len(self.text))
        junk = self.rng.choice(["\0", "\0" * 100, "\ufeff", "\x1b[31m", "\f", "\v",
                                "\r", "\u2028", "\udcff\udcfe"])
        return self.text[:k] + junk + self.text[k:], False

    def line_ends(self):
        ends = self.rng.choice(["\r\n", "\r", "\n\n", " \n", "\t\n", "\\\n"])
        text = ends.join(self.lines) + ends
        return self.rng.choice(["", "\ufeff"]) + text, False

    def truncated(self):
        return self.text[:self.rng.randrange(len(self.text))], False

    def byte_flips(self):
        data = bytearray(self.text.encode())
        for _ in range(self.rng.choice([1, 3, 30])):
            data[self.rng.randrange(len(data))] ^= 1 << self.rng.randrange(8)
        return bytes(data), False

    def junk(self):
        data = self.rng.randbytes(self.rng.choice([1, 10, 200, 5000, 300000]))
        first = data.split(b"\n")[0].strip()
        sure = len(data) >= 200 and bool(first) and first[:1] != b"#"
        return data, sure

    def include(self):
        what, sure = self.rng.choice([
            ("given.prm", True), ("./../given/given.prm", True),
            ("missing.prm", True), (".", True), ("/", True), ("", True),
            ("/dev/null", False), ("/proc/self/mem", True), ("x" * 5000, True),
            ("default.prm extra", True), ("../" * 2000 + "x", True)])
        self.lines.insert(0 if self.rng.random() < .5 else len(self.lines),
                          "include " + what)
        return self.joined(), sure

    def circle_of_two(self):
        self.case.write("given/other.prm", "include given.prm\n")
        return self.text + "include other.prm\n", True

    def many_lines(self):
        n = 10000 // max(1, len(self.lines)) + 1
        return self.text * n, False

    def long_line(self):
        return self.text + self.rng.choice(["#", "set ", "", "subsection "]) \
            + "x" * 1000000 + "\n", False

    def deep(self):
        n = self.rng.choice([10, 1000, 50000])
        ends = self.rng.choice([0, n])
        return "subsection A\n" * n + "set a = 1\n" + "end\n" * ends, True

    def alien(self):
        return self.rng.choice(ALIEN_TEXTS[:1] + ALIEN_TEXTS), False

    def nothing(self):
        return self.rng.choice(["", "\n", "#", " "]), False


# How often each is taken.
MUTATIONS = ("typo_in_name typo_in_name typo_in_section unbalanced unbalanced "
             "value value value value value value value repeated_lines shuffled "
             "strange_bytes strange_bytes line_ends truncated byte_flips "
             "byte_flips junk include include circle_of_two many_lines long_line "
             "deep alien nothing").split()


def given_text(case, program):
    """A real file, flattened or with its includes beside it, or all parameters
    as the program prints them."""
    if program in FILES:
        # The others are long runs.
        case.write("given/" + FILES[program].name, FILES[program].read_text())
    else:
        folder = case.context.root / "parameter_files" / program
        shutil.copytree(folder, case.folder / "given")
    file = case.rng.choice(sorted((case.folder / "given").glob("*.prm")))
    text = file.read_text() if case.rng.random() < .5 else flatten(file)
    if case.rng.random() < .3 or "set " not in text:
        text = printed_parameters(case, program)
    # The mesh file is not copied; sphere makes one.
    return text.replace("meshes/sphere_h4.msh",
                        str(case.context.root / "meshes" / "sphere_h4.msh"))


def run(case):
    rng = case.rng
    program = rng.choice(ALL + RUNS)
    if rng.random() < .04:
        # A good file of another program.
        other = rng.choice([name for name in ALL if name != program])
        text, sure = given_text(case, other), False
        case.note(f"a file of {other}")
    else:
        mutation = Mutation(case, program, given_text(case, program))
        name = rng.choice(MUTATIONS)
        text, sure = getattr(mutation, name)()
        case.note(name)
    prm = case.write("given/given.prm", text)
    expected = NOT_ACCEPTED if sure else ANY
    if rng.random() < .5:
        case.attempt(program, prm=prm, options=["--validate"], is_run=False,
                     expected=expected)
    else:
        settings = small(program)
        if program == "sphere" and rng.random() < .8:
            settings["Mesh/File"] = ""
        case.attempt(program, settings, prm=prm, expected=expected)
