# SPDX-License-Identifier: LGPL-2.1-or-later
"""Data of the programs for the harness: small runs, and their parameters as printed by
--print-parameters."""

import pathlib
import re
from dataclasses import dataclass, field

BARS = ["bar_sd", "bar_ss"]
BODIES = ["colliding_disks", "colliding_spheres", "stent_artery", "sliding_block",
          "ricochet"]
THROWN = ["elastic_ball", "hyperelastic_ring", "obstacle_course"] + BODIES
RUNS = BARS + THROWN + ["sphere"]
ALL = RUNS + ["spectral_radius"]

# A file for each program that cannot run without one.
FILES = {"ricochet": pathlib.Path(__file__).resolve().with_name("scene.prm")}

# Coarse meshes, and a time in which something touches.
MESH = {
    "bar_sd": {"Mesh/Mesh size": "0.1"},
    "bar_ss": {"Mesh/Mesh size": "0.1"},
    "elastic_ball": {"Mesh/Nodes": "200", "Mesh/Boundary nodes": "32"},
    "hyperelastic_ring": {"Mesh/Nodes around": "32", "Mesh/Nodes across": "3"},
    "sphere": {"Mesh/Mesh size": "10", "Mesh/Degree": "1"},
    "obstacle_course": {"Body/Boundary nodes": "32"},
    "colliding_disks": {"Disks/Rings of the left disk": "4",
                        "Disks/Rings of the right disk": "3"},
    "colliding_spheres": {"Spheres/Mesh size of the left sphere": "1",
                          "Spheres/Mesh size of the right sphere": "1"},
    "ricochet": {},
    "stent_artery": {"Geometry/Artery nodes along": "31",
                     "Geometry/Artery nodes across": "4",
                     "Geometry/Stent nodes along": "41",
                     "Geometry/Stent nodes across": "3"},
    "sliding_block": {"Block/Cells": "4", "Strip/Cells": "11"},
    "spectral_radius": {"Spectrum/Points": "11"},
}
START = {
    "elastic_ball": {"Start/Initial gap": "0.0055"},
    "hyperelastic_ring": {"Start/Initial gap": "0.055"},
    "sphere": {"Start/Initial velocity": "0, 0, -4"},
    "obstacle_course": {"Start/Initial velocity": "0, -2"},
    "colliding_disks": {"Disks/Distance": "2.001", "Disks/Offset": "1"},
    "colliding_spheres": {"Spheres/Distance": "2", "Spheres/Speed": "4"},
    "stent_artery": {"Geometry/Gap": "0.0001", "Deployment/Duration": "0.5"},
}
FINAL_TIME = {"bar_sd": "1.5", "bar_ss": "1", "elastic_ball": "0.015",
              "hyperelastic_ring": "0.15", "sphere": "1",
              "obstacle_course": "0.03", "colliding_disks": "0.032",
              "colliding_spheres": "0.032", "ricochet": "0.016",
              "stent_artery": "0.16", "sliding_block": "0.016"}
TIME_STEP = {"bar_sd": .05, "bar_ss": .05, "elastic_ball": .001,
             "hyperelastic_ring": .01, "sphere": .25, "obstacle_course": .002,
             "colliding_disks": .004, "colliding_spheres": .004, "ricochet": .002,
             "stent_artery": .02, "sliding_block": .002}


def small(program):
    """Settings of a run of a few steps."""
    settings = dict(MESH[program])
    settings.update(START.get(program, {}))
    if program in FINAL_TIME:
        settings["Time/Final time"] = FINAL_TIME[program]
        settings["Output/Log every"] = "0"
    return settings


def steps(program, number):
    """The final time after @p number steps."""
    return {"Time/Final time": repr(round(number * TIME_STEP[program], 9))}


@dataclass
class Parameter:
    name: str
    default: str
    text: str
    choices: list = field(default_factory=list)

    @property
    def type(self):
        if self.choices:
            return "choice"
        if self.default in ("true", "false"):
            return "bool"
        if re.fullmatch(r"-?\d+", self.default) and not self.is_real():
            return "integer"
        if is_number(self.default):
            return "real"
        if self.default and all(map(is_number, self.default.split(","))):
            return "list"
        return "text"

    def is_real(self):
        """Its documentation speaks of a unit, a fraction or a coefficient."""
        return bool(re.search(r"\((Pa|m|s|1/Pa|kg|m/s)[^)]*\)|[Cc]oefficient|"
                              r"[Ee]xponent|alpha|Variant|Poisson|[Tt]olerance",
                              self.text))


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def parse_parameters(text):
    """The parameters in what --print-parameters prints."""
    path, comment, parameters = [], [], []
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("#"):
            comment.append(line.lstrip("# "))
        elif line.startswith("subsection "):
            path.append(line.split(None, 1)[1])
            comment = []
        elif line == "end":
            path.pop()
        elif line.startswith("set "):
            name, value = line[4:].split("#")[0].split("=", 1)
            documentation = " ".join(comment)
            parameters.append(Parameter("/".join(path + [name.strip()]),
                                        value.strip(), documentation,
                                        choices_in(documentation)))
            comment = []
        elif not line:
            comment = []
    return parameters


def choices_in(text):
    """The allowed values, where the text lists them."""
    match = re.search(r"(?:Allowed[^:]*|[Oo]ne of|[Vv]alues):? ?"
                      r"(?:Any one of )?(\w[^.|]*(?: ?\| ?[^.|]+)+)", text)
    return [part.strip() for part in match[1].split("|")] if match else []


def start_of_command(case, program):
    """The program, with its file if it needs one."""
    return [str(case.context.programs / program)] + [
        str(FILES[name]) for name in FILES if name == program]


def parameters_of(case, program):
    """All parameters of a program; asked once."""
    def ask():
        words = start_of_command(case, program) + ["--print-parameters"]
        parameters = parse_parameters(case.execute(words).out)
        for parameter in parameters:
            if parameter.type == "text" or "Variant" in parameter.text:
                parameter.choices = ask_for_choices(case, program, parameter)
        return parameters
    return case.context.keep(("parameters", program), ask)


def ask_for_choices(case, program, parameter):
    """A refusal lists the allowed values."""
    words = start_of_command(case, program) + [
        "--validate", "--set", parameter.name + "=no such value"]
    answer = " ".join(case.execute(words).err.split())
    match = re.search(r"Allowed: Any one of (.*?)(?: Is |\. |$)", answer)
    return match[1].rstrip(".").split(", ") if match else []


def printed_parameters(case, program):
    """--print-parameters as text, asked once."""
    def ask():
        words = start_of_command(case, program) + ["--print-parameters"]
        return case.execute(words).out
    return case.context.keep(("printed", program), ask)
