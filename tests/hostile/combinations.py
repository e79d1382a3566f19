# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 3: combinations of parameters that look valid, with any magnitudes."""

import re

from programs import BODIES, MESH, RUNS, TIME_STEP, parameters_of, small

# These would only make a run long, or its balance open on purpose.
LEFT_ALONE = re.compile(
    r"Output/|Program|Mesh/(?!Degree|Cells)|Time/(Final time|Time step)|"
    r"tolerance|Tolerance|Maximum|/File$|/Folder$|"
    # Parameters of a scene, whose parts depend on each other; scenes.py changes them.
    r"Dimension|Units|^(Obstacle|Condition|Probe) |"
    r"^Body .*/(?!Law|Viscosity|Density|Young|Poisson)|"
    r"^Contact .*/(Surface|Against|Coupling)")


def is_used(parameter, chosen):
    """Does its documentation say that one of the chosen values uses it?"""
    match = re.search(r"\b(Not used|Used)\b (?:by|with) ([^.]*)", parameter.text)
    if not match:
        return True
    words = set(re.findall(r"[\w-]+", match[2].lower()))
    named = any(set(re.findall(r"[\w-]+", value.lower())) <= words
                for value in chosen)
    return named == (match[1] == "Used")


def random_number(rng, parameter):
    """Mostly near the default, sometimes of any size."""
    default = float(parameter.default)
    chance = rng.random()
    if parameter.type == "integer":
        near = rng.randrange(1, max(3, round(2 * default)))
        return str(near if chance < .9 else rng.choice([0, -1, 10 ** 9]))
    # A number below 1 without a unit is a fraction, most of all.
    is_fraction = 0 < default < 1 and "Pa" not in parameter.text
    if chance < .7:
        value = (default or .1) * 10 ** rng.uniform(-1, .1 if is_fraction else 1)
    elif chance < .8 and not is_fraction:
        value = (default or 1.) * 10 ** rng.uniform(-6, 6)
    elif chance < .9:
        value = rng.choice([0., -default, 1., 2., -1., .5, .499999])
    else:
        value = 10 ** rng.uniform(-300, 300)
    return repr(value)


def random_value(rng, parameter):
    if parameter.choices:
        return rng.choice(parameter.choices)
    if parameter.type == "bool":
        return rng.choice(["true", "false"])
    if parameter.type == "list":
        numbers = parameter.default.split(",")
        size = max(abs(float(number)) for number in numbers) or 1.
        return ", ".join(repr(size * rng.uniform(-2, 2)) for _ in numbers)
    return random_number(rng, parameter)


def scheme_for(rng, settings, choices):
    """Most treatments of papers A and B know the midpoint scheme only."""
    if "midpoint" in choices and rng.random() < .5:
        settings["Time/Scheme"] = "midpoint"


def material_for(rng, settings, program):
    """Values that go with a hyperelastic body, more often than by chance."""
    if program == "hyperelastic_ring" and rng.random() < .7:
        settings["Material/Viscosity"] = "none"


def pair_for(rng, settings, program):
    """Values that go with contact between bodies, more often than by chance."""
    if program not in BODIES or rng.random() < .2:
        return
    settings["Time/Scheme"] = "midpoint"
    for name, value in list(settings.items()):
        if name.endswith("/Treatment") and re.search("Nitsche|multipliers|Lagr", value):
            del settings[name]
    for name in list(settings):
        if name.startswith("Linear solver/") or name.endswith(("/Law", "/Viscosity")):
            del settings[name]


def random_settings(case, program):
    rng = case.rng
    parameters = [p for p in parameters_of(case, program)
                  if not LEFT_ALONE.search(p.name) and p.type != "text"]
    choices = {p.name: p for p in parameters if p.choices}
    settings = {}
    for name, parameter in choices.items():
        if rng.random() < .6:
            settings[name] = random_value(rng, parameter)
    if "Time/Scheme" in choices:
        scheme_for(rng, settings, choices["Time/Scheme"].choices)
    material_for(rng, settings, program)
    pair_for(rng, settings, program)
    chosen = [settings.get(name, p.default) for name, p in choices.items()]
    others = [p for p in parameters if p.name not in choices]
    for parameter in rng.sample(others, min(len(others), rng.randrange(5))):
        if is_used(parameter, chosen) or rng.random() < .1:
            settings[parameter.name] = random_value(rng, parameter)
    return settings


def run(case):
    rng = case.rng
    program = rng.choice(RUNS)
    settings = small(program)
    settings.update(random_settings(case, program))
    settings["Output/Fields every"] = str(rng.choice([0, 0, 1, 3]))
    settings["Output/Checkpoint every"] = str(rng.choice([0, 0, 2]))
    # Twice the step in half as many steps.
    n = rng.choice([2, 4, 8])
    step = TIME_STEP[program] * rng.choice([.1, 1, 1, 1, 2, 100])
    settings["Time/Time step"] = repr(step)
    settings["Time/Final time"] = repr(n * step)
    if rng.random() < .3:
        settings["Newton/Maximum iterations"] = str(rng.choice([1, 5, 100]))
        settings["Time/Maximum halvings"] = str(rng.choice([0, 2]))
    assert set(MESH[program]) <= set(settings)
    n_ranks = 2 if rng.random() < .05 else 1
    case.attempt(program, settings, n_ranks=n_ranks)
