# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 10: meshes for bodies of the program ricochet: of Gmsh in both formats, in 2D
and 3D, of first and second order, with names; scripts of geometries, and .vtk."""

import itertools

from case import ACCEPTED, ANY, NOT_ACCEPTED
from meshes import SIDES, TETRAHEDRA, Damage
from scene_text import STEP, Scene
from scenes import attempt

# Gmsh's number of a kind, the edges and faces that carry nodes at order 2, and whether
# there is one within.
HEXAHEDRON_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7),
                    (4, 5), (4, 7), (5, 6), (6, 7)]
HEXAHEDRON_FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5),
                    (2, 3, 7, 6), (4, 5, 6, 7)]
TYPES = {
    "line": (1, 8, [(0, 1)]),
    "triangle": (2, 9, [(0, 1), (1, 2), (2, 0)]),
    "quadrangle": (3, 10, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 1, 2, 3)]),
    "tetrahedron": (4, 11, [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3)]),
    "hexahedron": (5, 12, HEXAHEDRON_EDGES + HEXAHEDRON_FACES + [tuple(range(8))]),
}
# Type of the surface elements of a cell.
SURFACE = {"triangle": "line", "quadrangle": "line", "tetrahedron": "triangle",
           "hexahedron": "quadrangle"}


class Grid:
    """A row of n squares or cubes of side 1 above the origin. The lower side is called "foot" and
    has the number 1, the rest of the surface "rest" with 2; the first half of the cells is "soft"
    with 10, the others "hard" with 20."""

    def __init__(self, dim, n, simplices, order):
        self.dim, self.order = dim, order
        self.cell = (("triangle" if simplices else "quadrangle") if dim == 2 else
                     "tetrahedron" if simplices else "hexahedron")
        self.side = SURFACE[self.cell]
        self.nodes = {}
        self.cells, self.soft = [], []
        for i in range(n):
            self.add_cube(i, simplices, 2 * i < n)
        self.foot, self.rest = [], []
        self.find_sides()
        # Nodes between vertices come after these.
        if order == 2:
            self.cells = [self.second_order(self.cell, cell) for cell in self.cells]
            self.foot = [self.second_order(self.side, side) for side in self.foot]
            self.rest = [self.second_order(self.side, side) for side in self.rest]

    def node(self, *place):
        return self.nodes.setdefault(tuple(map(float, place)), len(self.nodes) + 1)

    def add_cube(self, i, simplices, soft):
        square = [(0, 0), (1, 0), (1, 1), (0, 1)]
        if self.dim == 2:
            corners = [self.node(i + x, y, 0) for x, y in square]
            split = [(0, 1, 2), (0, 2, 3)]
        else:
            corners = [self.node(i + x, y, z) for z in (0, 1) for x, y in square]
            split = TETRAHEDRA
        cells = [[corners[k] for k in part] for part in split] if simplices \
            else [corners]
        self.cells += cells
        self.soft += [soft] * len(cells)

    def sides_of(self, cell):
        """Sides, or edges in 2D, by their vertices."""
        if self.cell == "hexahedron":
            return [tuple(cell[k] for k in side) for side in SIDES]
        if self.cell == "tetrahedron":
            return list(itertools.combinations(cell, 3))
        return list(zip(cell, cell[1:] + cell[:1]))

    def find_sides(self):
        count = {}
        for cell in self.cells:
            for side in self.sides_of(cell):
                count.setdefault(tuple(sorted(side)), []).append(side)
        below = {k for place, k in self.nodes.items() if place[self.dim - 1] == 0}
        for sides in count.values():
            if len(sides) == 1:
                (self.foot if set(sides[0]) <= below else self.rest).append(
                    list(sides[0]))

    def second_order(self, kind, vertices):
        places = {k: place for place, k in self.nodes.items()}
        more = []
        for group in TYPES[kind][2]:
            points = [places[vertices[k]] for k in group]
            more.append(self.node(*(sum(x) / len(points) for x in zip(*points))))
        return list(vertices) + more

    def number_of(self, kind):
        return TYPES[kind][self.order - 1]

    def names(self):
        d = self.dim
        return ["$PhysicalNames", "4", f'{d - 1} 1 "foot"', f'{d - 1} 2 "rest"',
                f'{d} 10 "soft"', f'{d} 20 "hard"', "$EndPhysicalNames"]

    def blocks(self):
        soft = [cell for cell, is_soft in zip(self.cells, self.soft) if is_soft]
        hard = [cell for cell, is_soft in zip(self.cells, self.soft) if not is_soft]
        d, side, cell = self.dim, self.number_of(self.side), self.number_of(self.cell)
        blocks = [(d - 1, 1, 1, side, self.foot), (d - 1, 2, 2, side, self.rest),
                  (d, 1, 10, cell, soft), (d, 2, 20, cell, hard)]
        return [block for block in blocks if block[4]]

    def format_22(self):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"] + self.names()
        lines += ["$Nodes", str(len(self.nodes))]
        lines += [f"{k} {x} {y} {z}" for (x, y, z), k in self.nodes.items()]
        lines += ["$EndNodes", "$Elements", str(sum(len(b[4]) for b in self.blocks()))]
        number = 0
        for _, tag, group, kind, elements in self.blocks():
            for nodes in elements:
                number += 1
                lines.append(" ".join(map(str, [number, kind, 2, group, tag, *nodes])))
        return lines + ["$EndElements"]

    def format_41(self):
        n, d = len(self.nodes), self.dim
        bounds = "0 0 0 100 1 1"
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat"] + self.names()
        counts = [0, 0, 0, 0]
        entities = []
        for block_dim, tag, group, _, _ in self.blocks():
            counts[block_dim] += 1
            end = " 0" if block_dim == d - 1 else " 2 1 2"
            entities.append(f"{tag} {bounds} 1 {group}{end}")
        lines += ["$Entities", " ".join(map(str, counts))] + entities + ["$EndEntities"]
        lines += ["$Nodes", f"1 {n} 1 {n}", f"{d} 1 0 {n}"]
        lines += [str(k) for k in self.nodes.values()]
        lines += [f"{x} {y} {z}" for x, y, z in self.nodes]
        total = sum(len(block[4]) for block in self.blocks())
        lines += ["$EndNodes", "$Elements", f"{len(self.blocks())} {total} 1 {total}"]
        number = 0
        for block_dim, tag, _, kind, elements in self.blocks():
            lines.append(f"{block_dim} {tag} {kind} {len(elements)}")
            for nodes in elements:
                number += 1
                lines.append(" ".join(map(str, [number, *nodes])))
        return lines + ["$EndElements"]

    def vtk(self):
        kind = {"triangle": 5, "quadrangle": 9, "tetrahedron": 10,
                "hexahedron": 12}[self.cell]
        n = len(self.cells[0])
        lines = ["# vtk DataFile Version 2.0", "a row", "ASCII",
                 "DATASET UNSTRUCTURED_GRID", f"POINTS {len(self.nodes)} double"]
        lines += [f"{x} {y} {z}" for x, y, z in self.nodes]
        lines.append(f"CELLS {len(self.cells)} {len(self.cells) * (n + 1)}")
        lines += [" ".join(map(str, [n] + [k - 1 for k in cell])) for cell in self.cells]
        lines.append(f"CELL_TYPES {len(self.cells)}")
        return lines + [str(kind)] * len(self.cells)


class SceneDamage(Damage):
    """Changes of meshes with names, of any dimension."""

    dim = 3

    def below(self):
        """Cells and surface change sides: all is under the floor."""
        for line in self.node_lines():
            word = self.dim - 4
            height = float(self.lines[line].split()[word])
            self.replace_word(line, word, repr(height - 50))
        return self.text(), True

    def flat(self):
        for line in self.node_lines():
            self.replace_word(line, self.dim - 4, 2)
        return self.text(), True

    def coordinates(self):
        text, sure = super().coordinates()
        # In 2D the third coordinate is only read.
        return text, sure

    def no_surface_one(self):
        """The surface that the scene names has another name."""
        self.lines = [line.replace('1 "foot"', '1 "fut"') for line in self.lines]
        return self.text(), True

    def names(self):
        first = self.lines.index("$PhysicalNames")
        k = first + 2 + self.rng.randrange(4)
        self.lines[k] = self.rng.choice([
            "", '1 1 foot', '1 1 "foot', '9 1 "foot"', '-1 1 "foot"', '1 -1 "foot"',
            '1 99999999999 "foot"', '1 1 "a;b"', '1 1 "' + "x" * 5000 + '"', '1 1 ""',
            '1 1 "2"', '1 2 "foot"', 'a b "foot"', '2 10 "soft" 3', '"'])
        return self.text(), False

    def count_of_names(self):
        first = self.lines.index("$PhysicalNames")
        self.lines[first + 1] = self.rng.choice(["0", "-1", "3", "5", "1e9", "x", "",
                                                 "4294967296"])
        return self.text(), True


DAMAGES = ("none none header counts counts small_counts node_tag_missing "
           "node_tag_missing node_repeated node_repeated nodes_exchanged "
           "nodes_exchanged nodes_exchanged element_type element_type element_type "
           "coordinates truncated byte_flips byte_flips byte_flips lines_deleted "
           "lines_deleted lines_repeated section_gone below flat no_surface_one names "
           "names names count_of_names nothing").split()

SQUARE = """Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
"""
GROUPS = """Physical Curve("foot", 1) = {1}; Physical Curve("rest", 2) = {2, 3, 4};
Physical Surface("soft", 10) = {1};
"""
CUBE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
"""
CUBE_GROUPS = """Physical Surface("foot", 1) = {5};
Physical Surface("rest", 2) = {1, 2, 3, 4, 6};
Physical Volume("soft", 10) = {1};
"""

# Text to find, to put in its place, and whether that is wrong for sure.
MISTAKES = [
    ("};", "}", True), ("1", "q", True), ("{1, 2}", "{1, 7}", True),
    ("{1, 2, 3, 4}", "{1, 2, 4}", True), ("{1, 2, 3, 4}", "{4, 3, 2, 1}", False),
    ("Plane Surface(1) = {1};", "", True), ("Plane Surface(1)", "Surface(1)", False),
    ("Plane Surface(1) = {1}", "Plane Surface(1) = {2}", True),
    ("Point(3) = {1, 1, 0}", "Point(3) = {0, 0, 0}", False),
    ("Point(3) = {1, 1, 0}", "Point(3) = {1e300, 1, 0}", False),
    ("Point(3) = {1, 1, 0}", "Point(3) = {-1, 0.5, 0}", False),
    ("Point(3) = {1, 1, 0}", "Point(3) = {1, 1, 5}", False),
    ("Point(3) = {1, 1, 0}", "Point(3) = {1/0, 1, 0}", False),
    ("Box(1) = {0, 0, 0, 1, 1, 1}", "Box(1) = {0, 0, 0, 0, 0, 0}", True),
    ("Box(1) = {0, 0, 0, 1, 1, 1}", "Box(1) = {0, 0, 0, 1, 1, 1e-9}", False),
    ("Box(1) = {0, 0, 0, 1, 1, 1}", "Box(2) = {0, 0, 0, 1, 1, 1}", False),
    ("Box(1) = {0, 0, 0, 1, 1, 1}", "Rectangle(1) = {0, 0, 0, 1, 1}", True),
    ("SetFactory(\"OpenCASCADE\")", "SetFactory(\"none\")", True),
    ("\"foot\", 1", "\"foot\", -1", True), ("\"foot\", 1", "\"fut\", 1", True),
    ("\"foot\", 1", "\"foot\", 2", False), ("\"foot\", 1", "\"foot\"", False),
    ("\"foot\", 1", "\"foot\", 1e10", False), ("\"soft\", 10", "\"soft\", 0", False),
    ("= {2, 3, 4}", "= {1, 2, 3, 4}", False), ("= {2, 3, 4}", "= {9}", False),
    ("{1};\n", "{1}; Mesh 2; Mesh 3;\n", False),
]
# Put at the end, or at the beginning.
COMMANDS = [
    "Exit;", "Abort;", "Error(\"an error\");", "Merge \"nothing.geo\";",
    "Include \"nothing.geo\";", "Delete All;", "Recombine Surface {1};",
    "Mesh.ElementOrder = 2;", "Mesh.ElementOrder = 5;", "Mesh.RecombineAll = 1;",
    "Mesh.MeshSizeFactor = 1e-9;", "Mesh.MeshSizeMax = 1e-7;", "Mesh.Algorithm = 99;",
    "Mesh.SubdivisionAlgorithm = 1;", "Mesh.SaveAll = 1;", "Mesh.MeshSizeMax = -1;",
    "Transfinite Curve {1} = 0;", "Transfinite Curve {1} = 3;", "Mesh.Binary = 1;",
    "Mesh.MshFileVersion = 1;", "Physical Point(\"p\", 5) = {1};", "Coherence;",
    "Physical Curve(\"twice\", 7) = {1};", "Save \"x.msh\";", "Mesh 1;", "Mesh 2;",
    "Mesh.SecondOrderIncomplete = 1; Mesh.ElementOrder = 2;", "Plugin(None).Run;",
    "Point(50) = {7, 7, 7};", "Line(50) = {1, 3};", "NewModel;", "For i In {1:3}",
    "If (1)", "/*", "\"", "#", "General.Terminal = 1;", "Printf(\"hello\");",
    "SystemCall \"touch mark\";", "NonBlockingSystemCall \"touch mark\";",
    "OnelabRun(\"touch mark\", \"touch mark\");", "Printf(\"x\") > \"mark\";",
    "Save \"mark.msh\";", "Print \"mark.png\";", "CreateDir \"mark\";",
    "Mesh.MeshOnlyEmpty = 1;", "Embed;", "Point{1} In Surface{1};"]


def damaged_lines(case, lines):
    """Damages of a mesh in a format without sections."""
    rng = case.rng
    lines = list(lines)
    name = rng.choice(["none", "byte_flips", "word", "word", "word", "truncated",
                       "deleted", "repeated", "nothing"])
    case.note(name)
    if name == "word":
        k = rng.randrange(len(lines))
        words = lines[k].split(" ")
        words[rng.randrange(len(words))] = rng.choice(
            ["-1", "0", "99999", "nan", "1e400", "x", "", "4294967296", "1.5", "1e9"])
        lines[k] = " ".join(words)
    elif name == "deleted":
        del lines[rng.randrange(len(lines))]
    elif name == "repeated":
        k = rng.randrange(len(lines))
        lines.insert(k, lines[k])
    text = "\n".join(lines) + "\n"
    if name == "truncated":
        text = text[:rng.randrange(len(text))]
    elif name == "nothing":
        return rng.choice(["", "\n", "\0" * 100, "# vtk\n"]), NOT_ACCEPTED
    elif name == "byte_flips":
        data = bytearray(text.encode())
        for _ in range(rng.choice([1, 3, 10])):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
        return bytes(data), ANY
    return text, ACCEPTED if name == "none" else ANY


def geometry(case, dim):
    """A script with a mistake."""
    rng = case.rng
    base, groups = (SQUARE, GROUPS) if dim == 2 else (CUBE, CUBE_GROUPS)
    text, expected = base + groups, ANY
    chance = rng.random()
    if chance < .05:
        case.note("good geometry")
        return text, ACCEPTED
    if chance < .55:
        fitting = [m for m in MISTAKES if m[0] in text]
        old, new, sure = rng.choice(fitting)
        case.note(f"{old!r} -> {new!r}")
        text = text.replace(old, new, 1)
        expected = NOT_ACCEPTED if sure else ANY
    elif chance < .95:
        command = rng.choice(COMMANDS)
        case.note(command)
        if rng.random() < .3:
            # In another file.
            case.write("more.geo", command + "\n")
            command = rng.choice(["Include", "Merge"]) + ' "more.geo";'
        text = rng.choice([command + "\n" + text, text + command + "\n",
                           base + command + "\n" + groups])
    else:
        case.note("no geometry")
        text = rng.choice(["", "\0\0", "solid\n", groups, "x" * 100000, "Point(1) = {"])
        expected = NOT_ACCEPTED
    return text, expected


def make_file(case, dim):
    """A file, the expected result, whether it has names, and its order."""
    rng = case.rng
    ending = rng.choices([".msh", ".geo", ".vtk"], [60, 30, 10])[0]
    if ending == ".geo":
        text, expected = geometry(case, dim)
        return case.write("mesh.geo", text), expected, True, 1
    order = rng.choice([1, 2]) if ending == ".msh" else 1
    grid = Grid(dim, rng.choice([1, 2, 3]), rng.random() < .5, order)
    case.note(f"{grid.cell} of order {order}, {ending}")
    if ending != ".msh":
        text, expected = damaged_lines(case, grid.vtk())
        return case.write("mesh.vtk", text), expected, False, 1
    damage = SceneDamage(case, rng.choice([grid.format_22, grid.format_41])())
    damage.dim = dim
    name = rng.choice(DAMAGES)
    case.note(name)
    text, sure = getattr(damage, name)()
    expected = NOT_ACCEPTED if sure else ACCEPTED if name == "none" else ANY
    return case.write("mesh.msh", text), expected, True, order


def run(case):
    rng = case.rng
    scene = Scene(rng.choice([2, 3]))
    file, expected, has_names, order = make_file(case, scene.dim)
    if rng.random() < .03:
        file = case.folder / rng.choice(["missing.msh", "missing.geo", ".", "mesh.stl",
                                         "mesh.inp"])
        expected = NOT_ACCEPTED
    scene.add("Body row", File=file.name, Law="linear elastic", Mesh_size=.5,
              Translation=scene.vector(up=1e-3), Velocity=scene.vector(up=-1.))
    if has_names and rng.random() < .3:
        scene.sections["Body row"]["Materials"] = "soft: steel"
        scene.add("Material steel", Law="linear elastic", Young_modulus="1e7")
    scene.add("Obstacle floor", Shape="half space", Direction=scene.vector(up=1.))
    scene.add("Contact floor", Surface="row: foot" if has_names else "row",
              Against="floor", Treatment="penalty")
    scene.add("Mesh", Degree=order)
    scene.add("Time", Time_step=STEP, Final_time=3 * STEP)
    scene.add("Output", Fields_every=1, Log_every=0)
    # Less than a case may take: a size factor of 1e-9 meshes for ever.
    scene.add("Limits", Meshing_time=20)
    prm = case.write("given.prm", scene.text())
    attempt(case, prm, expected, validate=rng.random() < .4)
    if list(case.folder.rglob("mark*")):
        case.finding("a geometry has run a command, or written a file")
