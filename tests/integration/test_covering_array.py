# SPDX-License-Identifier: LGPL-2.1-or-later
"""A few steps of so many combinations that each pair of choices that is taken occurs.

The list is that of `ricochet --combinations`, from the rules in the library. Each run touches,
closes its balance, keeps its promise (the exit code), and ends without more than two halved steps, as
it does with right tangents. With --full each three choices that are taken occur. And
of what is refused, a row for each reason is refused by the program, with that reason.
"""

import csv
import itertools
import random
import re
import zlib

from common import *

CHOICES = ("treatment", "contact", "scheme", "mass", "friction", "viscosity", "material",
           "dimension", "degree")
STEPS = 5

SCENE = """
set Program   = ricochet
set Dimension = {dimension}
subsection Material rubber
  set Law           = {law}
  set Plane state   = plane strain
  set Young modulus = 1e6
  set Poisson ratio = 0.3
  set Density       = 1000
  set Viscosity     = {viscosity}
  {viscosity_eta}
end
subsection Mesh
  set Degree = {degree}
end
{bodies}
subsection Contact joint
  set Surface   = {surface}
  set Against   = {against}
  set Treatment = {treatment}
  {coupling}
  set Friction law = {friction_law}
  {friction}
  {choice}
end
subsection Time
  set Scheme     = {scheme}
  set Mass       = {mass}
  set Time step  = {step}
  set Final time = {end}
end
subsection Output
  set Fields every = 0
end
"""


def block(name, place, velocity, dim, cells):
    size = ", ".join(["1"] * dim)
    along = ", ".join([str(cells)] * dim)
    return f"""subsection Body {name}
  set Shape       = {"rectangle" if dim == 2 else "block"}
  set Size        = {size}
  set Cells along = {along}
  set Translation = {", ".join(map(str, place))}
  set Velocity    = {", ".join(map(str, velocity))}
  set Material    = rubber
end
"""


def clamp(path, dim, n):
    """A mesh of a block with a slot, whose sides are 0.01 apart, as text of Gmsh's format, with
    n cells across the arms, of unequal heights. Boundary 1 is both sides of the slot, 2 the foot."""
    numbers, cells, sides = {}, [], []

    def add(x, y, z):
        return numbers.setdefault((x, y, z), len(numbers) + 1)

    zs = [k / n for k in range(n + 1)] if dim == 3 else [0., None]

    def boxes(xs, ys, side=None):
        for (x0, x1), (y0, y1), (z0, z1) in itertools.product(*(
                list(zip(values, values[1:])) for values in (xs, ys, zs))):
            around = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
            levels = [z0] if dim == 2 else [z0, z1]
            cells.append([add(x, y, z) for z in levels for x, y in around])
            if side in (x0, x1):
                corners = [add(side, y, z0) for y in (y0, y1)]
                sides.append((1, corners if dim == 2 else
                              corners + [add(side, y, z1) for y in (y1, y0)]))
            if y0 == 0.:
                corners = [add(x, y0, z0) for x in (x0, x1)]
                sides.append((2, corners if dim == 2 else
                              corners + [add(x, y0, z1) for x in (x1, x0)]))

    left = [k / n * .495 for k in range(n + 1)]
    right = [1. - x for x in reversed(left)]
    foot = 1. / n
    boxes(left + right, [0., foot])
    boxes(left, [foot + k / n for k in range(n + 1)], left[-1])
    boxes(right, [foot + k / (n + 1) for k in range(n + 2)], right[0])
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(numbers))]
    lines += [f"{number} {x} {y} {z}" for (x, y, z), number in numbers.items()]
    lines += ["$EndNodes", "$Elements", str(len(cells) + len(sides))]
    elements = [(3 if dim == 2 else 5, 0, cell) for cell in cells]
    elements += [(1 if dim == 2 else 3, tag, side) for tag, side in sides]
    lines += [f"{k} {kind} 2 {tag} {tag} " + " ".join(map(str, nodes))
              for k, (kind, tag, nodes) in enumerate(elements, 1)]
    path.write_text("\n".join(lines + ["$EndElements", ""]), encoding="utf-8")


def condition(name, boundary, kind, dim, depth=0.):
    value = "  set Value = " + "0; " * (dim - 1) + f"-{depth}*t\n"
    return f"""subsection Condition {name}
  set Boundary = {boundary}
  set Kind     = {kind}
{value * (kind == "displacement")}end
"""


def scene(folder, row):
    """The text of a scene with the choices of a row of the list. Without inertia bodies are held and
    pressed instead of thrown."""
    dim = int(row["dimension"])
    is_static = row["scheme"] == "static"
    speed = 0 if is_static else -1
    treatment, *choice = row["treatment"].split(", ")
    is_linear = row["material"] == "linear elastic"
    # With fewer than four cells across a body the mass cannot be redistributed.
    n = 4 if row["mass"] == "redistributed" else 2
    def at(height):
        return [0] * (dim - 1) + [height]
    # A slot that closes by less than a quarter of itself in a step.
    closes = row["contact"] == "itself" and not is_static
    coupling = ""
    if "obstacle" in row["contact"]:
        motion = "  set Translation = 0.1*t" + "; 0" * (dim - 1) + "\n"
        bodies = block("upper", at(.001), at(speed), dim, n) + (
            "subsection Obstacle floor\n  set Shape = half space\n" +
            motion * (row["contact"] == "moving obstacle") + "end\n")
        surface, against = "upper: lower", "floor"
    elif row["contact"] == "itself":
        mesh = folder / f"clamp-{dim}-{n}.msh"
        if not mesh.exists():
            clamp(mesh, dim, n)
        # Arms accelerated towards each other, or pressed.
        load = "7500*t" if row["viscosity"] == "yes" else "6000*t"
        rate = f"-{load if is_static else 900}*(x-0.5)*y^2" + "; 0" * (dim - 1)
        bodies = (f"subsection Body clamp\n  set File         = {mesh}\n"
                  f"  set Material     = rubber\n  set Acceleration = {rate}\nend\n")
        surface, against = "clamp: 1", "itself"
    else:
        gap = 0. if row["contact"] == "cut faces" else .001
        bodies = (block("lower", at(0), at(0), dim, n) +
                  block("upper", at(1 + gap), at(speed), dim, n + 1))
        surface, against = "upper: lower", "lower: upper"
        coupling = f"set Coupling = {row['contact']}"
    if is_static:
        if row["contact"] == "itself":
            bodies += condition("foot", "clamp: 2", "fixed", dim)
        else:
            # By 4 mm within five steps.
            bodies += condition("press", "upper: upper", "displacement", dim, .8)
        if "lower" in against:
            bodies += condition("foot", "lower: lower", "fixed", dim)
    friction = {"none": "", "Coulomb": "set Friction coefficient = 0.3",
                "slip-rate dependent": "set Static coefficient = 0.4\n"
                                       "  set Dynamic coefficient = 0.2\n"
                                       # A steep fall has several solutions in a step.
                                       "  set Slip-rate decay = 1"}[row["friction"]]
    # Coulomb's stick is regularised or exact, in half of the rows each that may choose. With
    # a falling coefficient a single point may have no state that follows from both others.
    if row["friction"] == "Coulomb" and row["contact"] != "cut faces" and not re.match(
            "Signorini active set|persistent|Ayyad", treatment):
        row_number = zlib.crc32(repr(sorted(row.items())).encode())
        friction += "\n  set Stick = " + ("regularised", "exact")[row_number % 2]
    return SCENE.format(
        dimension=dim, degree=row["degree"], mass=row["mass"], scheme=row["scheme"],
        law=row["material"] if is_linear else "neo-Hookean",
        viscosity="none" if row["viscosity"] == "no" else "linear" if is_linear else "Curnier",
        viscosity_eta="" if row["viscosity"] == "no" else "set Viscosity eta = 100",
        bodies=bodies, surface=surface, against=against, treatment=treatment,
        coupling=coupling, friction=friction,
        friction_law=row["friction"] if "slip" in row["friction"] else "Coulomb",
        choice="set Nitsche " + choice[0] if choice else "", end=1e-2 if closes else STEPS * 1e-3,
        step=5e-4 if closes else 1e-3)


def covering_array(rows, strength):
    """Rows that have all values of any @p strength choices that occur together."""
    def groups(row):
        return {tuple((name, row[name]) for name in names)
                for names in itertools.combinations(CHOICES, strength)}
    generator = random.Random(1)
    rows = list(rows)
    generator.shuffle(rows)
    of_row = [groups(row) for row in rows]
    missing = set().union(*of_row)
    where = {}
    for k, own in enumerate(of_row):
        for group in own:
            where.setdefault(group, []).append(k)
    chosen = []
    while missing:
        # The row with the most, among those that have one that is missing.
        group = min(missing, key=lambda one: (len(where[one]), one))
        best = max(where[group][:300], key=lambda k: len(of_row[k] & missing))
        chosen.append(rows[best])
        missing -= of_row[best]
    return chosen


class CoveringArray(ProgramTest):

    def setUp(self):
        super().setUp()
        text = subprocess.run([program_path("ricochet"), "--combinations"], check=True,
                              capture_output=True, text=True).stdout
        rows, reasons = text.split("\n\n")
        self.rows = list(csv.DictReader(rows.splitlines()))
        self.reasons = reasons.splitlines()

    def attempt_row(self, numbered, options=()):
        number, row = numbered
        folder = self.folder / str(number)
        path = self.folder / f"{number}.prm"
        path.write_text(scene(self.folder, row), encoding="utf-8")
        code, out, error = self.attempt("ricochet", NO_FIELDS, folder, prm=path,
                                        options=list(options))
        return row, folder, code, out, error

    @staticmethod
    def is_left_out(row):
        """Points of a surface against itself are released where they are deeper than half of what is
        between both sides, as a wall cannot be distinguished from a slot: the scene is too narrow for
        ARKODE's balance and, in 3D, for the many facets of degree 2."""
        return row["contact"] == "itself" and (
            row["scheme"] == "ARKODE" or (row["dimension"], row["degree"]) == ("3", "2"))

    def test_what_is_taken(self):
        taken = [row for row in self.rows if row["taken"] == "yes" and not self.is_left_out(row)]
        strength = 3 if os.environ.get("RICOCHET_FULL") else 2
        if is_debug_build():
            # With assertions in 2D; a surface against itself in test_self_contact.py.
            taken = [row for row in taken
                     if row["dimension"] == "2" and row["contact"] != "itself"]
        chosen = covering_array(taken, strength)
        print(f"{len(chosen)} of {len(taken)} combinations")
        with ThreadPoolExecutor(max_workers=2) as pool:
            for row, folder, code, out, error in pool.map(self.attempt_row,
                                                          enumerate(chosen)):
                with self.subTest(", ".join(row[name] for name in CHOICES)):
                    # A promise that is broken is 4.
                    self.assertEqual(code, 0, msg=out + error)
                    ledger = Ledger(folder)
                    self.assertLess(largest(ledger["balance_residual"]), 1e-9)
                    # The force at the end of a step may be zero where that in between is not.
                    self.assertGreater(max(ledger["contact_force_joint"]) +
                                       largest(ledger["contact_work"]), 0.)
                    self.assertLessEqual(ledger["step_halvings"][-1], 2)
                    stages = 2 if row["scheme"] in ("TR-BDF2", "BDF2") else 1
                    if "two-step" in row["treatment"]:
                        stages = 2
                    if "Stick = exact" in folder.with_suffix(".prm").read_text():
                        # Passes after the first one take one to three iterations each. Round-off
                        # decides on how many there are: 84 and 87 iterations of one row with the
                        # kernels of two processors.
                        stages *= 2.5
                    self.assertLess(max(ledger["newton_iterations"]), 40 * stages)

    def test_what_is_refused(self):
        """One row for each reason; the program says the same sentence."""
        refused = [row for row in self.rows if row["taken"] != "yes"]
        chosen = []
        for number in range(1, len(self.reasons) + 1):
            chosen.append(next(row for row in refused if int(row["taken"]) == number))
        with ThreadPoolExecutor(max_workers=2) as pool:
            for row, _, code, out, error in pool.map(
                    lambda one: self.attempt_row(one, ["--validate"]), enumerate(chosen)):
                reason = self.reasons[int(row["taken"]) - 1]
                with self.subTest(reason):
                    self.assertEqual(code, 1, msg=out + error)
                    # Names stand for themselves here, and lists are broken into lines.
                    words = re.split("TREATMENT|SCHEME|COUPLING", reason.split(". ")[0])
                    said = " ".join(error.split())
                    for part in words:
                        self.assertIn(part.strip(), said)

    def test_the_page_is_made_from_the_rules(self):
        sys.path.insert(0, str(ROOT / "doc"))
        import make_combinations
        page = make_combinations.PAGE.read_text(encoding="utf-8")
        self.assertEqual(page, make_combinations.with_tables(
            page, make_combinations.tables(self.rows, self.reasons)),
            msg="run doc/make_combinations.py")


if __name__ == "__main__":
    main()
