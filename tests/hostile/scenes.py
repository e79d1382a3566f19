# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 9: scenes for the program ricochet, with mistakes."""

import contract
from case import ACCEPTED, ANY, NOT_ACCEPTED
from combinations import random_value
from parameter_files import MUTATIONS, NO_NUMBERS, ODD_NUMBERS, Mutation
from scene_text import KINDS, STEP, parameters_in, random_scene

BAD_NAMES = ["", " ", "a:b", "a;b", "a,b", "a/b", "x" * 61, "é", "#", "\"a\"",
             "a=b", "a\tb", "(a)", "*", "itself"]
ODD_NAMES = ["x" * 60, "a b", "a  b", "1", "-", ".", "..", "_", "NAME", "0", "energy",
             "x", "total", "1e5", "nan", "A", "contact", "end", "set", "subsection"]

# Beside a body that exists, here as '@'.
BAD_SURFACES = ["", " ", ";", "nobody", "@x", "@ @", "@: nowhere", "@: 99", "@: -1",
                "@: 1.5", "@:", "@: ,", "@: 0; nobody", "@; @", "@, @", "@:: 0",
                "@: 0: 1", "@: 4294967295", "@: 18446744073709551616", "itself; @",
                "'@'", "@;;nobody", "@: é", "x" * 3000, "@: " + "9" * 500]
ODD_SURFACES = ["@;", ";@", "@ :0", " @ ", "@: 0, 0", "@: 0,", "@:0;@:1", "itself",
                " itself ", "floor", "@: upper, lower", "@: 0"]

BAD_EXPRESSIONS = ["x +", "foo(x)", "1;;", "(((((", "if(t<0.1, 1", "1/0", "sqrt(-1)",
                   "0/0", "w", "x y", "1e400", "t ? 1", "\\", "1,2", "x = 3", "π",
                   "log(-1)", "1/0*t", "nan", "()", "sin()", "sin", "\"1\"", "`ls`"]
ODD_EXPRESSIONS = ["log(t)", "1/t", "rand()", "rand_seed(1)", "1e300*x", "-1e-300",
                   "t^t^t", "1" + "+1" * 3000, "(" * 300 + "1" + ")" * 300,
                   "if(t<0.001, 0, 1e9)", "sqrt(t-0.001)", "x*y", "1e12", "pi", "_pi",
                   "sin(1e300*t)", "t > 0.002", "abs(t)", "1/(t-0.002)", "0"]

# Functions of GridGenerator, with all their arguments; the centre is 'o'.
GENERATORS = {
    2: ["hyper_cube = 0 : 1 : true", "subdivided_hyper_cube = 3 : 0 : 1 : false",
        "hyper_rectangle = o : 1, 2 : true", "cheese = 3, 2", "hyper_ball = o : 1 : true",
        "subdivided_hyper_rectangle = 2, 2 : o : 1, 1 : true",
        "general_cell = 0, 0; 1, 0; 0, 1; 1, 1 : false", "hyper_L = -1 : 1 : false",
        "hyper_cube_slit = 0 : 1 : false", "hyper_ball_balanced = o : 1",
        "half_hyper_ball = o : 1", "quarter_hyper_ball = o : 1",
        "enclosed_hyper_cube = 0 : 1 : 0.2 : true", "hyper_cross = 1, 1, 1, 1 : false",
        "hyper_shell = o : 0.5 : 1 : 12 : true", "hyper_shell = o : 0.5 : 1 : 0 : false",
        "half_hyper_shell = o : 0.5 : 1 : 0 : false",
        "quarter_hyper_shell = o : 0.5 : 1 : 0 : false",
        "eccentric_hyper_shell = o : 0.1, 0 : 0.5 : 1 : 12",
        "hyper_cube_with_cylindrical_hole = 0.25 : 0.5 : 0.5 : 1 : false",
        "plate_with_a_hole = 0.4 : 1 : 1 : 1 : 1 : 1 : o : 0 : 1 : 1 : 2 : false",
        "channel_with_cylinder = 0.03 : 2 : 2 : false", "simplex = 0, 0; 1, 0; 0, 1",
        "concentric_hyper_shells = o : 0.125 : 0.25 : 2 : 0.1 : 8 : false"],
    3: ["hyper_cube = 0 : 1 : true", "hyper_ball = o : 1 : false", "cylinder = 0.5 : 1",
        "subdivided_cylinder = 2 : 0.5 : 1", "truncated_cone = 1 : 0.5 : 1",
        "hyper_shell = o : 0.5 : 1 : 6 : true", "hyper_shell = o : 0.5 : 1 : 96 : true",
        "subdivided_hyper_rectangle = 2, 1, 2 : o : 1, 1, 1 : true",
        "torus = 1 : 0.3 : 6 : 6.283185307", "moebius = 6 : 1 : 2 : 0.5",
        "cylinder_shell = 1 : 0.5 : 1 : 8 : 2", "hyper_L = -1 : 1 : false",
        "half_hyper_ball = o : 1", "quarter_hyper_ball = o : 1",
        "half_hyper_shell = o : 0.5 : 1 : 0 : false",
        "quarter_hyper_shell = o : 0.5 : 1 : 0 : false", "cheese = 2, 1, 2",
        "simplex = 0, 0, 0; 1, 0, 0; 0, 1, 0; 0, 0, 1",
        "enclosed_hyper_cube = 0 : 1 : 0.2 : true", "hyper_cube_slit = 0 : 1 : false",
        "concentric_hyper_shells = o : 0.125 : 0.25 : 2 : 0.1 : 12 : false"]}
NO_GENERATORS = ["Hyper_cube", "none", "hyper_sphere", "airfoil", "pipe_junction", "x",
                 "reference_cell", "", "hyper cube", "hyper_cube "]
ARGUMENTS = ["0", "1", "-1", "2", "3", "5", "7", "0.5", "1e-300", "1e300", "1e-12", "nan",
             "inf", "-0.5", "300", "4294967296", "1e9", "true", "", "a", "0, 0", "1, 1",
             "1;", "x" * 2000]

BAD_UNITS = ["", "m", "m, kg", "m, kg, s, K", "mm; t; s", "1, 2, 3", "m,, s", ",,",
             "µ, kg, s", "m kg s"]
ODD_UNITS = ["mm, t, s", "m,kg,s", " m , kg , s ", "um, ug, ms", "mm, g, ms", "cm, g, s",
             "a, b, c", "m, m, m", "s, kg, m"]

# Combinations with schemes and masses, and some that are never allowed.
CHANCES = {"Treatment": .6, "Scheme": .35, "Friction coefficient": .3, "Coupling": .25}
COMBINED = ("Contact NAME", "Time", "Body NAME", "Mesh", "Linear solver")
LEFT_ALONE = ("File", "Shape", "Generator", "Generator arguments", "Surface", "Against",
              "Materials", "Acceleration", "Translation", "Final time", "Time step",
              "Refinements", "Size", "Cells along", "Radius", "Mesh size", "Units",
              "Nodes", "Nodes around", "Nodes across", "Scale", "Cells",
              "ARKODE absolute tolerance", "ARKODE relative tolerance",
              "Maximum halvings", "Rotation", "Rotation axis", "Inner radius")


class SceneMutation(Mutation):
    """Damages of any file."""

    def __init__(self, case, scene, parameters):  # pylint: disable=super-init-not-called
        self.case, self.rng = case, case.rng
        self.text = scene.text()
        self.lines = self.text.splitlines()
        self.parameters = {}
        for name in scene.sections:
            for parameter in parameters:
                section, _, own = parameter.name.rpartition("/")
                if section in (name, name.split(" ")[0] + " NAME"):
                    self.parameters[f"{name}/{own}"] = parameter

    def typo_in_section(self):
        """Users' names may be anything, as far as nothing refers to them."""
        text, _ = super().typo_in_section()
        return text, False


# ### Changes of a scene; each says whether the result is invalid for sure

def pick(rng, bad, odd):
    sure = rng.random() < .5
    return rng.choice(bad if sure else odd), sure


def name_of_section(scene, rng, _):
    """Anything for a name; references to it follow."""
    kind = rng.choice(KINDS)
    names = scene.of_kind(kind)
    new, sure = pick(rng, BAD_NAMES, ODD_NAMES)
    if not names:
        scene.add(f"Material {new}")
        return sure and new != "itself"
    old = rng.choice(names)
    scene.sections = {f"{kind} {new}" if name == old else name: settings
                      for name, settings in scene.sections.items()}
    own = old.split(" ", 1)[1]
    for settings in scene.sections.values():
        for key in ("Surface", "Against", "Boundary", "Body"):
            if key in settings:
                settings[key] = settings[key].replace(own, new)
    if new == "itself":
        return kind in ("Body", "Obstacle")
    return sure


def reference(scene, rng, _):
    """To what there is not."""
    places = [(settings, key) for settings in scene.sections.values()
              for key in ("Surface", "Against", "Boundary", "Body") if key in settings]
    settings, key = rng.choice(places)
    value, sure = pick(rng, BAD_SURFACES, ODD_SURFACES)
    settings[key] = value.replace("@", rng.choice(scene.names("Body")))
    return sure


def reference_misspelt(scene, rng, _):
    settings, key = rng.choice([
        (settings, key) for settings in scene.sections.values()
        for key in ("Surface", "Against", "Boundary", "Body") if key in settings])
    k = rng.randrange(len(settings[key]))
    settings[key] = settings[key][:k] + rng.choice("qxz;:,é #") + settings[key][k + 1:]
    return False


def section_twice(scene, rng, _):
    """The same section again, or one that differs by a blank and an underscore."""
    name = rng.choice(list(scene.sections))
    if rng.random() < .5:
        scene.more = f"subsection {name}\nend\n"
        return False
    kind = name.split(" ")[0]
    if kind not in KINDS:
        return False
    settings = dict(scene.sections[name])
    scene.sections[kind + " one two"] = settings
    scene.sections[kind + " one_two"] = settings
    return True


def section_gone(scene, rng, _):
    del scene.sections[rng.choice(list(scene.sections))]
    return not scene.of_kind("Body")


def section_within(scene, rng, _):
    name = rng.choice(list(scene.sections))
    scene.more = f"subsection {name}\nsubsection Body inner\nend\nend\n"
    return True


def wrong_kind_of_section(scene, rng, _):
    kind = rng.choice(["Bodies", "body", "BODY", "Bodyball", "Contacts", "Force",
                       "Condition", "Body", "Time step", "Meshes", "Time x", ""])
    scene.more = f"subsection {kind}\n  set Kind = fixed\nend\n"
    return True


def list_of_wrong_length(scene, rng, parameters):
    """A number too few or too many, or none."""
    places = [(name, parameter.name.rpartition("/")[2]) for name in scene.sections
              for parameter in parameters if parameter.type == "list"
              and parameter.name.rpartition("/")[0]
              in (name, name.split(" ")[0] + " NAME")]
    name, key = rng.choice(places)
    n = rng.choice([k for k in (0, 1, scene.dim - 1, scene.dim + 1, 100)
                    if k != scene.dim])
    scene.sections[name][key] = rng.choice([", ", ",", "; ", " "]).join(["1"] * n)
    # The list of a shape without arguments is not read.
    return key not in ("Size", "Cells along") or \
        scene.sections[name].get("Shape") in ("rectangle", "block")


def expression(scene, rng, _):
    """Expressions of loads, displacements, motions of obstacles, level sets."""
    text, sure = pick(rng, BAD_EXPRESSIONS, ODD_EXPRESSIONS)
    several = "; ".join([text] + ["0"] * (scene.dim - 1))
    if rng.random() < .15:
        # Too many, or too few.
        text = several = "; ".join(["0"] * rng.choice([scene.dim - 1, scene.dim + 1, 9]))
        sure = True
    where = rng.choice(["Acceleration", "Translation", "Rotation", "Value", "Value",
                        "Function", "Gradient"])
    body, obstacle = scene.of_kind("Body")[0], scene.sections["Obstacle floor"]
    if where == "Acceleration":
        scene.sections[body][where] = several
    elif where == "Translation":
        obstacle[where] = several
    elif where == "Rotation":
        obstacle[where] = text
        sure = sure and "x" not in text
    elif where == "Value":
        scene.add("Condition more", Kind=rng.choice(["traction", "displacement"]),
                  Boundary=scene.on_top[scene.names("Body")[0]][0], Value=several)
    else:
        obstacle["Shape"] = "level set"
        obstacle["Function"] = "xyz"[scene.dim - 1]
        obstacle["Gradient"] = "; ".join(["0"] * (scene.dim - 1) + ["1"])
        obstacle[where] = text if where == "Function" else several
    return sure


def on_top_of_each_other(scene, rng, _):
    """Two coincident bodies."""
    bodies = scene.of_kind("Body")
    first = bodies[0]
    if len(bodies) == 1:
        scene.sections["Body twin"] = dict(scene.sections[first])
        scene.add("Contact twins", Surface=scene.names("Body")[0], Against="twin",
                  Treatment=rng.choice(["improved normal compliance",
                                        "persistent contact", "penalty"]))
        # Coincident bodies of one shape have no node within the other.
        return True
    shift = rng.choice([0., .1, .25])
    scene.sections[bodies[1]]["Translation"] = ", ".join(
        repr(float(x) + shift) for x in
        scene.sections[first]["Translation"].split(", "))
    return False


def obstacle_through_body(scene, rng, _):
    floor = scene.sections["Obstacle floor"]
    depth = rng.choice([.01, .1, .3, 100.])
    floor["Centre"] = scene.vector(up=depth)
    if rng.random() < .3:
        floor["Shape"] = "circle" if scene.dim == 2 else "sphere"
        floor["Radius"] = rng.choice(["0.1", "1", "1e-30", "1e30"])
        floor["Body inside"] = rng.choice(["true", "false"])
        return False
    return True


def odd_obstacle(scene, rng, _):
    floor = scene.sections["Obstacle floor"]
    floor["Shape"] = rng.choice(["half space", "level set"] + (
        ["circle"] if scene.dim == 2 else ["sphere", "cylinder", "torus"]))
    floor["Body inside"] = rng.choice(["true", "false"])
    floor["Centre"] = scene.vector(up=rng.choice([-1., -10., 0., .5]))
    floor["Radius"] = rng.choice(["1", "10", "0.1"])
    if scene.dim == 3:
        floor["Tube radius"] = rng.choice(["0.1", "1", "10"])
    if rng.random() < .3:
        floor["Direction"] = scene.vector()
        return floor["Shape"] in ("half space", "cylinder", "torus")
    return False


def self_contact(scene, rng, _):
    name = rng.choice(scene.names("Body"))
    treatment = rng.choice(["improved normal compliance", "penalty",
                            "persistent contact", "standard normal compliance"])
    scene.add("Contact of itself", Surface=rng.choice([name, name, name + ": 0"]),
              Against="itself", Treatment=treatment,
              Coupling=rng.choice(["points", "cut faces"] if treatment == "penalty" else
                                  ["points", "points", "mortar", "dual mortar"]),
              Friction_coefficient=rng.choice(["0", "0.3"]))
    return False


def combination(scene, rng, parameters):
    """Treatments, schemes, friction, laws, degrees, solvers as chance has them; more
    often than it has, laws, viscosities and schemes go together."""
    for parameter in parameters:
        section, _, key = parameter.name.rpartition("/")
        if section not in COMBINED or key in LEFT_ALONE or parameter.type == "text":
            continue
        for name in scene.sections if section.endswith(" NAME") else [section]:
            chance = CHANCES.get(key, .1 if parameter.choices else .05)
            if name.split(" ")[0] == section.split(" ")[0] and rng.random() < chance:
                scene.add(name)[key] = random_value(rng, parameter)
    if rng.random() < .2:
        return False
    if len(scene.of_kind("Contact")) > 1 or rng.random() < .6:
        scene.add("Time", Scheme="midpoint", Mass="consistent")
    if rng.random() < .8:
        scene.sections.get("Linear solver", {}).pop("Factorisation", None)
    choose_laws(scene, rng)
    for name in scene.of_kind("Contact"):
        own = scene.sections[name]
        if rng.random() < .7:
            own.pop("Coupling", None)
        if "Compliance exponent" in own:
            own["Compliance exponent"] = rng.choice(["2", "2.5", "3"])
    return False


def choose_laws(scene, rng):
    """One kind of law for all bodies, with a viscosity that fits."""
    is_linear = rng.random() < .5
    for name in scene.of_kind("Body"):
        own = scene.sections[name]
        own["Law"] = "linear elastic" if is_linear else \
            rng.choice(["neo-Hookean", "Saint Venant-Kirchhoff"])
        own["Viscosity"] = rng.choice(["none", "linear"] if is_linear else
                                      ["none", "Curnier", "Pioletti"])
        own["Viscosity eta"] = "0" if own["Viscosity"] == "none" else "10"
        if scene.dim == 3:
            own.pop("Plane state", None)


def materials(scene, rng, _):
    """Materials of parts of a body."""
    name = rng.choice(scene.of_kind("Body"))
    own = scene.sections[name]
    if rng.random() < .7:
        own.update({"Shape": "generator", "Generator": "subdivided_hyper_rectangle",
                    "Generator arguments": "2, 2 : -0.5, -0.5 : 0.5, 0.5 : true"
                    if scene.dim == 2 else
                    "2, 2, 2 : -0.5, -0.5, -0.5 : 0.5, 0.5, 0.5 : true",
                    "Refinements": "1" if scene.dim == 2 else "0"})
        # The names of its boundaries go, and it is alone.
        scene.sections = {key: value for key, value in scene.sections.items()
                          if key.split(" ")[0] not in ("Body", "Contact", "Condition",
                                                       "Probe") or key == name}
        own["Translation"] = scene.vector(up=.501)
        scene.add("Contact floor", Surface=name[5:], Against="floor",
                  Treatment="penalty", Friction_coefficient=rng.choice(["0", "0.3"]))
        scene.add("Probe stress", Body=name[5:], Quantity="stress")
    bad = ["0", "0:", ":", ": steel", "99: steel", "0: iron", "0: steel: 1", "-1: steel",
           "0 steel", "0: steel; 99: steel", "x" * 3000, "é: steel", "0: steel, 1: steel"]
    odd = ["0: steel", "0: steel; 1: steel", "0: steel;", "1: steel; 0: rubber",
           "0: steel; 0: rubber", "0:steel", " 0 : steel ", "0: steel; 1: rubber", ""]
    own["Materials"], sure = pick(rng, bad, odd)
    law = own["Law"] if rng.random() < .8 else "Saint Venant-Kirchhoff"
    scene.add("Material steel", Law=law, Young_modulus="1e7",
              Density=rng.choice(["8000", "8000", "8000", "0", "1e-20", "1e20"]))
    scene.add("Material rubber", Law=law, Poisson_ratio=rng.choice(["0.3", "0.4999"]))
    return sure


def springs(scene, rng, _):
    sizes = ["0", "1e3", "1e3", "1e4", "1e12", "1e-300", "-1", "nan"]
    own = scene.add("Condition springs", Kind="springs",
                    Boundary=rng.choice(scene.names("Body")),
                    Stiffness=rng.choice(sizes), Damping=rng.choice(sizes))
    own["Components"] = rng.choice(["", "", "x", "y", "x, y", "y, x", "x, x", "z", "q",
                                    "xy", "x; y", ",", "X", " x "])
    if rng.random() < .4:
        scene.add("Time", Scheme=rng.choice(["TR-BDF2", "HHT", "Crank-Nicolson",
                                             "ARKODE"]))
        for name in scene.of_kind("Contact"):
            scene.sections[name]["Treatment"] = "penalty"
    return (own["Components"] in ("q", "xy", "x; y", "X")
            or own["Components"] == "z" and scene.dim == 2
            or "-1" in own.values() or "nan" in own.values()
            or own["Stiffness"] == own["Damping"] == "0")


def conditions(scene, rng, _):
    """Several on one boundary, on surfaces in contact, on all of a body."""
    body = rng.choice(scene.names("Body"))
    # Nodal contact and prescribed displacements have no common nodes.
    for name in scene.of_kind("Contact")[:rng.choice([0, 1, 1])]:
        scene.sections[name]["Treatment"] = "penalty"
    boundaries = [scene.on_top[body][0], scene.on_top[body][1], body]
    for k in range(rng.choice([1, 2, 2, 3])):
        kind = rng.choice(["fixed", "displacement", "traction"])
        own = scene.add(f"Condition {k}", Kind=kind, Boundary=rng.choice(boundaries))
        if rng.random() < .4:
            own["Components"] = rng.choice(["x", "y", "x, y"])
        if kind != "fixed":
            own["Value"] = "; ".join(rng.choice(["0", "t", "1e3*sin(100*t)", "x", "1"])
                                     for _ in range(scene.dim))
    if rng.random() < .15:
        scene.add("Time", Scheme=rng.choice(["TR-BDF2", "HHT", "Crank-Nicolson",
                                             "ARKODE"]))
    return False


def units(scene, rng, _):
    scene.top["Units"], sure = pick(rng, BAD_UNITS, ODD_UNITS)
    return sure


def generator(scene, rng, _):
    """With one argument that is odd, missing or too much."""
    name = scene.of_kind("Body")[0]
    own = scene.sections[name]
    dim = scene.dim if rng.random() < .9 else 5 - scene.dim
    chosen, arguments = rng.choice(GENERATORS[dim]).split(" = ")
    words = arguments.replace("o", ", ".join(["0"] * dim)).split(" : ")
    chance = rng.random()
    if chance < .6:
        k = rng.randrange(len(words))
        parts = words[k].split(", ")
        parts[rng.randrange(len(parts))] = rng.choice(ARGUMENTS)
        words[k] = ", ".join(parts)
    elif chance < .7:
        words.insert(rng.randrange(len(words) + 1), rng.choice(ARGUMENTS))
    elif chance < .75:
        del words[rng.randrange(len(words))]
    own.update({"Shape": "generator", "Generator": chosen,
                "Generator arguments": " : ".join(words),
                "Refinements": rng.choice(["0", "0", "1"])})
    if rng.random() < .1:
        own["Generator"] = rng.choice(NO_GENERATORS)
    if rng.random() < .8:
        # A body alone, without contact: any valid mesh is accepted.
        scene.sections = {key: value for key, value in scene.sections.items()
                          if key in (name, "Time", "Output")}
        own["Cells"] = rng.choice(["automatic", "triangles or tetrahedra"])
    return own["Generator"] in NO_GENERATORS[:-1]


def shape(scene, rng, _):
    """Bodies of odd sizes."""
    name = rng.choice(scene.of_kind("Body"))
    own = scene.sections[name]
    key = rng.choice(["Scale", "Radius", "Inner radius", "Nodes around", "Nodes across",
                      "Nodes", "Size", "Cells along", "Mesh size", "Rotation", "Shape",
                      "Translation", "Velocity", "Spin", "Refinements"])
    n = scene.dim
    own[key] = rng.choice({
        "Radius": ["1e-30", "1e30", "0.3", "0.1", "0", "-1"],
        "Inner radius": ["0.5", "0.6", "1e-30", "1e30", "0", "0.499999999"],
        "Nodes around": ["8", "9", "10", "12", "17", "64", "100"],
        "Nodes across": ["2", "30", "1", "10000"], "Nodes": ["1", "16", "17", "9999999"],
        "Size": [", ".join(["1e-12"] * n), ", ".join(["1e12"] * n),
                 ", ".join(["1e-9"] + ["1"] * (n - 1)), ", ".join(["1e-320"] * n),
                 ", ".join(["-1"] * n), ", ".join(["1e200"] * n)],
        "Cells along": [", ".join(["1"] * n), ", ".join(["100000"] * n),
                        ", ".join(["0"] * n), ", ".join(["4294967295"] * n),
                        ", ".join(["1.5"] * n)],
        "Mesh size": ["0", "1e-9", "1e9", "10", "0.05", "1e-300"],
        "Shape": ["none", "disk", "ring", "rectangle", "ball", "block", "generator"],
        "Refinements": ["0", "1", "3", "9"],
        "Velocity": [scene.vector(up=-1e9), scene.vector(up=1e300),
                     scene.vector(up=-1e-300)],
        "Spin": ["1e9", "0, 0, 1", "1e300", "0, 0, 1e5"],
        "Translation": [scene.vector(up=1e17), scene.vector(up=1e300),
                        scene.vector(across=1e9), scene.vector(up=-1.)],
    }.get(key, ["1e-30", "1e30", "1e-200", "1e308", "0", "-1", "1e5", "1e-9"]))
    return False


def dimension(scene, rng, _):
    scene.top["Dimension"] = rng.choice([str(5 - scene.dim), "1", "4", "", "two", "2.0",
                                         "2 3", "-2", "0x2", "٢"])
    return True


def number(scene, rng, parameters):
    """An odd one for any parameter of any section."""
    numbers = [p for p in parameters if p.type in ("integer", "real", "list")]
    parameter = rng.choice(numbers)
    section, _, key = parameter.name.rpartition("/")
    names = [name for name in scene.sections if name.split(" ")[0] + " NAME" == section]
    name = section if not section.endswith(" NAME") else rng.choice(names or ["Time"])
    wrong = rng.random() < .4
    scene.add(name)[key] = rng.choice(NO_NUMBERS if wrong else ODD_NUMBERS)
    return wrong


def probes(scene, rng, _):
    own = scene.add("Probe more", Body=scene.names("Body")[-1],
                    Quantity=rng.choice(["stress", "velocity", "displacement"]))
    own["Point"] = rng.choice(["", scene.vector(up=1e9), scene.vector(up=1e300), "0",
                               "0, 0, 0, 0", "nan, nan, nan", scene.vector(up=.5), ";"])
    if rng.random() < .3:
        own["Body"] = rng.choice(scene.names("Body") + ["floor", ""]) \
            + rng.choice(["", ":", ": 0", ";", " "])
        return own["Body"].startswith("floor") or own["Body"].endswith((": 0", ":", ";"))
    return own["Point"] in ("0", "0, 0, 0, 0", "nan, nan, nan", ";")


def many(scene, rng, _):
    """Many sections of a kind."""
    kind = rng.choice(["Contact", "Obstacle", "Condition", "Probe", "Body", "Material"])
    n = rng.choice([5, 30]) if kind in ("Contact", "Body") else rng.choice([20, 300])
    body = scene.names("Body")[0]
    settings = {
        "Contact": {"Surface": scene.on_top[body][0], "Against": "floor",
                    "Treatment": rng.choice(["improved normal compliance", "penalty",
                                             "persistent contact"])},
        "Obstacle": {"Shape": "half space"},
        "Condition": {"Boundary": body, "Kind": "springs", "Stiffness": "1"},
        "Probe": {"Body": body}, "Material": {},
        "Body": dict(scene.sections["Body " + body])}[kind]
    for k in range(n):
        scene.sections[f"{kind} number {k}"] = settings
    return False


def several_partners(scene, rng, _):
    """Contacts of several surfaces with several partners."""
    bodies = scene.names("Body")
    scene.add("Obstacle ceiling", Shape="half space", Centre=scene.vector(up=9.),
              Direction=scene.vector(up=-1.))
    scene.add("Contact several", Treatment=rng.choice(
        ["improved normal compliance", "penalty", "persistent contact", "Nitsche"]),
        Surface="; ".join(rng.choices(bodies, k=rng.choice([1, 2, 3]))),
        Against="; ".join(rng.choices(
            rng.choice([bodies, ["floor", "ceiling"], ["floor", "ceiling", *bodies]]),
            k=rng.choice([1, 2, 3]))))
    return False


def degree(scene, rng, _):
    scene.add("Mesh", Degree=rng.choice(["1", "2", "2", "2", "0", "3", "1.5"]))
    for name in scene.of_kind("Body"):
        if scene.dim == 3 and rng.random() < .5:
            scene.sections[name]["Curved cells"] = "true"
    return scene.sections["Mesh"]["Degree"] in ("0", "3", "1.5")


def times(scene, rng, _):
    scene.add("Time", Time_step=rng.choice([STEP, STEP / 100, 1e-12, 10., 1e300]))
    scene.add("Time", Final_time=rng.choice(
        [1, 3, .5, 0, -1]) * float(scene.sections["Time"]["Time step"]))
    return float(scene.sections["Time"]["Final time"]) <= 0.


def good_scene(_scene, _rng, _parameters):
    return False


CHANGES = [
    (name_of_section, 4), (reference, 8), (reference_misspelt, 3), (section_twice, 2),
    (section_gone, 3), (section_within, 1), (wrong_kind_of_section, 1),
    (list_of_wrong_length, 4), (expression, 8), (on_top_of_each_other, 3),
    (obstacle_through_body, 3), (odd_obstacle, 4), (self_contact, 3), (combination, 16),
    (materials, 5), (springs, 4), (conditions, 4), (units, 2), (generator, 9), (shape, 6),
    (dimension, 2), (number, 7), (probes, 3), (many, 2), (several_partners, 3),
    (degree, 3), (times, 2), (good_scene, 3)]


def run(case):
    rng = case.rng
    scene = random_scene(rng)
    parameters = parameters_in(case, scene.dim)
    sure = False
    if rng.random() < .15:
        name = rng.choice([m for m in MUTATIONS if m != "include"])
        text, sure = getattr(SceneMutation(case, scene, parameters), name)()
    else:
        changes, weights = zip(*CHANGES)
        change = rng.choices(changes, weights)[0]
        sure, name = change(scene, rng, parameters), change.__name__
        if rng.random() < .05:
            second = rng.choices(changes, weights)[0]
            try:
                sure = second(scene, rng, parameters) and False
                name += " and " + second.__name__
            except (KeyError, IndexError, ValueError):
                sure = False
        text = scene.text()
    case.note(name)
    prm = case.write("given/given.prm", text)
    expected = NOT_ACCEPTED if sure else ACCEPTED if name == "good_scene" else ANY
    attempt(case, prm, expected, validate=rng.random() < .25,
            n_ranks=rng.choice([2, 3]) if rng.random() < (
                .3 if name == "expression" else .03) else 1)


def attempt(case, prm, expected, validate, n_ranks=1):
    """A check or a run. Input refused by a run is refused by the check, too."""
    if validate:
        case.attempt("ricochet", prm=prm, options=["--validate"], is_run=False,
                     expected=expected)
        return
    result = case.attempt("ricochet", prm=prm, expected=expected, n_ranks=n_ranks)
    if result.code == 1 and case.rng.random() < .5:
        words = case.command("ricochet", prm=prm, options=["--validate"])
        check = case.execute(words)
        if check.code == 0:
            case.finding("--validate accepts what a run refuses",
                         contract.first_sentence(result.err))
