# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes for the program ricochet: one to three bodies above each other on a floor,
with contacts, conditions and probes, that run a few steps."""

import re

from programs import parse_parameters

KINDS = ["Body", "Material", "Obstacle", "Contact", "Condition", "Probe"]
NAMES = ["ball", "brick", "lower part"]

# Treatments that need no other scheme or mass, and take several contacts of a body.
LAWS = ["improved normal compliance", "standard normal compliance", "penalty",
        "Hauret-Le Tallec"]
CONSTRAINTS = ["persistent contact", "Signorini active set"]

STEP = 2e-3


class Scene:
    """The sections of a parameter file, and text that comes after them."""

    def __init__(self, dim):
        self.dim = dim
        self.top = {"Program": "ricochet", "Dimension": str(dim)}
        self.sections = {}
        self.more = ""
        self.on_top = {}

    def add(self, name, **settings):
        """Settings are given with _ for blanks."""
        own = self.sections.setdefault(name, {})
        for key, value in settings.items():
            own[key.replace("_", " ")] = str(value)
        return own

    def of_kind(self, kind):
        return [name for name in self.sections if name.split(" ")[0] == kind]

    def names(self, kind):
        return [name.split(" ", 1)[1] for name in self.of_kind(kind)]

    def vector(self, up=0., across=0., separator=", "):
        """Upwards is the last direction, across the first."""
        numbers = [across] + [0.] * (self.dim - 2) + [up]
        return separator.join(f"{number:.9g}" for number in numbers)

    def text(self):
        lines = [f"set {key} = {value}" for key, value in self.top.items()]
        for name, settings in self.sections.items():
            lines.append("subsection " + name)
            lines += [f"  set {key} = {value}" for key, value in settings.items()]
            lines.append("end")
        return "\n".join(lines) + "\n" + self.more


def add_body(scene, rng, name, bottom, simplices):
    """A body whose lowest point is at @p bottom; returns its highest."""
    dim = scene.dim
    round_ = ["disk", "ring"] if dim == 2 else ["ball"] * simplices
    shape = rng.choice(round_ + ["box", "box", "generator"])
    own = scene.add("Body " + name)
    own["Cells"] = ("triangles or tetrahedra" if simplices
                    else "quadrilaterals or hexahedra")
    below, above, height, middle = name, name, 1., .5
    if shape == "box":
        own["Shape"] = "rectangle" if dim == 2 else "block"
        own["Size"] = "1, 0.5" if dim == 2 else "1, 1, 0.5"
        own["Cells along"] = "4, 2" if dim == 2 else "2, 2, 1"
        below, above, height, middle = name + ": lower", name + ": upper", .5, 0.
    elif shape == "generator":
        own["Shape"] = "generator"
        own["Generator"], own["Generator arguments"], middle = rng.choice([
            ("hyper_cube", "0 : 1 : true", 0.),
            ("hyper_ball",
             "0, 0 : 0.5 : false" if dim == 2 else "0, 0, 0 : 0.5 : false", .5),
            ("subdivided_hyper_rectangle", "2, 2 : 0, 0 : 1, 1 : true" if dim == 2
             else "2, 2, 1 : 0, 0, 0 : 1, 1, 1 : true", 0.)])
        own["Refinements"] = "1" if dim == 2 else "0"
    else:
        own["Shape"] = shape
        own["Radius"] = "0.5"
        if dim == 2:
            own["Nodes around"] = "16"
            own["Nodes across"] = "3"
            own["Inner radius"] = "0.3"
        else:
            own["Mesh size"] = "0.4"
    own["Translation"] = scene.vector(up=bottom + middle,
                                      across=-.5 if middle == 0. else 0.)
    own["Velocity"] = scene.vector(up=-1., across=.1)
    own["Law"] = rng.choice(["linear elastic", "neo-Hookean"])
    own["Young modulus"] = rng.choice(["1e5", "1e6"])
    scene.on_top[name] = below, above
    return bottom + height


def random_scene(rng):
    """One that should run."""
    scene = Scene(rng.choice([2, 2, 3]))
    n = rng.choice([1, 1, 2, 2, 3])
    simplices = rng.random() < .4
    bottom = 1e-3
    for name in NAMES[:n]:
        bottom = add_body(scene, rng, name, bottom, simplices) + 1e-3
    if rng.random() < .7:
        # The same law for all, as one run needs.
        for name in scene.of_kind("Body"):
            scene.add(name, Law="neo-Hookean")
    else:
        for name in scene.of_kind("Body"):
            scene.add(name, Law="linear elastic")
    add_contacts(scene, rng)
    add_conditions(scene, rng, NAMES[n - 1])
    name = rng.choice(NAMES[:n])
    scene.add("Probe stress", Body=name, Quantity="stress")
    scene.add("Probe motion", Body=name, Point=scene.vector(up=.5),
              Quantity=rng.choice(["displacement", "velocity"]))
    scene.add("Start", Gravity=scene.vector(up=-9.81))
    scene.add("Time", Time_step=STEP, Final_time=rng.choice([2, 3, 5]) * STEP)
    scene.add("Output", Fields_every=rng.choice([0, 1]), Log_every=0)
    return scene


def add_contacts(scene, rng):
    """The lowest on the floor, the others on the one below, and perhaps a wall."""
    bodies = scene.names("Body")
    scene.add("Obstacle floor", Shape="half space",
              Direction=scene.vector(up=1.))
    friction = {"Friction coefficient": rng.choice(["0", "0", "0.3"])}
    below = scene.on_top[bodies[0]][0]
    scene.add("Contact on floor", Surface=below, Against="floor",
              Treatment=rng.choice(LAWS + CONSTRAINTS)).update(friction)
    for low, high in zip(bodies, bodies[1:]):
        scene.add(f"Contact {low}-{high}", Surface=scene.on_top[low][1],
                  Against=scene.on_top[high][0], Treatment=LAWS[0]).update(friction)
    if rng.random() < .3:
        scene.add("Obstacle wall", Shape="half space",
                  Centre=scene.vector(across=.502),
                  Direction=scene.vector(across=-1.))
        # Its surface may have common nodes with held boundaries.
        scene.add("Contact at wall", Surface="; ".join(bodies), Against="wall",
                  Treatment="penalty")
    if len(bodies) == 1 and scene.dim == 2 and rng.random() < .3:
        scene.add("Contact of itself", Surface=bodies[0], Against="itself",
                  Treatment=LAWS[0])


def add_conditions(scene, rng, highest):
    if rng.random() < .5:
        return
    boundary = scene.on_top[highest][1]
    kind = rng.choice(["fixed", "displacement", "traction", "springs"])
    if ":" not in boundary and kind in ("fixed", "displacement"):
        return
    own = scene.add("Condition top", Boundary=boundary, Kind=kind)
    if kind in ("traction", "displacement"):
        factor = "1e-2*t" if kind == "displacement" else "100*(1+0*x)"
        own["Value"] = "; ".join([factor] * scene.dim)
    if kind == "springs":
        own["Stiffness"] = "1e3"
        own["Damping"] = rng.choice(["0", "10"])


def parameters_in(case, dim):
    """All parameters, with NAME for the names of sections; asked once."""
    program = str(case.context.programs / "ricochet")

    def ask():
        words = [program, "--print-parameters", "--set", f"Dimension={dim}"]
        parameters = parse_parameters(case.execute(words).out)
        base = case.write("all.prm", f"set Program = ricochet\nset Dimension = {dim}\n"
                          + "".join(f"subsection {kind} NAME\nend\n" for kind in KINDS))
        for parameter in parameters:
            if parameter.type == "text" or "Variant" in parameter.text:
                words = [program, str(base), "--validate", "--set",
                         parameter.name + "=no such value"]
                answer = " ".join(case.execute(words).err.split())
                match = re.search(r"Allowed: Any one of (.*?)(?: Is |\. |$)", answer)
                parameter.choices = match[1].split(", ") if match else []
        return parameters
    return case.context.keep(("parameters of scenes", dim), ask)
