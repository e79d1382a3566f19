# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 4: mesh files for the sphere, real ones and made ones, damaged."""

from case import ACCEPTED, ANY, NOT_ACCEPTED

QUADRANGLE, TRIANGLE, TETRAHEDRON, HEXAHEDRON = 3, 2, 4, 5

# The sides of a hexahedron as Gmsh numbers its vertices, the lowest first.
SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6),
         (3, 0, 4, 7)]
# Six tetrahedra around the diagonal from vertex 0 to vertex 6.
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6),
              (0, 4, 5, 6), (0, 5, 1, 6)]


class Box:
    """A row of n cubes of side 10, two above the foundation: the contact surface is the lower side,
    physical surface 1; the others are physical surface 2."""

    def __init__(self, n, tetrahedra):
        self.nodes = {}
        self.cells, self.lower, self.others = [], [], []
        for i in range(n):
            corners = [self.node(i + x, y, z) for z in (0, 1)
                       for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
            sides = [(corners[a], corners[b], corners[c], corners[d])
                     for a, b, c, d in SIDES]
            if tetrahedra:
                self.add_tetrahedra(corners)
            else:
                self.cells.append(corners)
                self.lower.append(sides[0])
                self.others += [side for k, side in enumerate(sides) if k in (1, 2, 4)
                                or (k == 5 and i == 0) or (k == 3 and i == n - 1)]
        self.tetrahedra = tetrahedra
        if tetrahedra:
            self.find_sides()

    def node(self, *place):
        return self.nodes.setdefault(place, len(self.nodes) + 1)

    def add_tetrahedra(self, corners):
        self.cells += [[corners[k] for k in cell] for cell in TETRAHEDRA]

    def find_sides(self):
        """Triangles that one tetrahedron alone has."""
        count = {}
        for cell in self.cells:
            for k in range(4):
                side = tuple(cell[:k] + cell[k + 1:])
                count.setdefault(tuple(sorted(side)), []).append(side)
        below = {number for place, number in self.nodes.items() if place[2] == 0}
        for sides in count.values():
            if len(sides) == 1:
                (self.lower if set(sides[0]) <= below else self.others).append(sides[0])

    def coordinates(self):
        return [(number, 10 * x, 10 * y, 2 + 10 * z)
                for (x, y, z), number in self.nodes.items()]

    def types(self):
        return (TRIANGLE, TETRAHEDRON) if self.tetrahedra else (QUADRANGLE, HEXAHEDRON)

    def format_41(self):
        """In Gmsh's format 4.1: two surfaces and a volume."""
        n, bounds = len(self.nodes), "0 0 2 100 10 12"
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Entities", "0 0 2 1",
                 f"1 {bounds} 1 1 0", f"2 {bounds} 1 2 0", f"1 {bounds} 1 10 2 1 2",
                 "$EndEntities", "$Nodes", f"1 {n} 1 {n}", f"3 1 0 {n}"]
        lines += [str(number) for number, *_ in self.coordinates()]
        lines += [f"{x} {y} {z}" for _, x, y, z in self.coordinates()]
        side_type, cell_type = self.types()
        blocks = [(2, 1, side_type, self.lower), (2, 2, side_type, self.others),
                  (3, 1, cell_type, self.cells)]
        total = sum(len(block[3]) for block in blocks)
        lines += ["$EndNodes", "$Elements", f"3 {total} 1 {total}"]
        number = 0
        for dimension, tag, kind, elements in blocks:
            lines.append(f"{dimension} {tag} {kind} {len(elements)}")
            for element in elements:
                number += 1
                lines.append(" ".join(map(str, [number, *element])))
        return lines + ["$EndElements"]

    def format_22(self):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
                 str(len(self.nodes))]
        lines += [f"{k} {x} {y} {z}" for k, x, y, z in self.coordinates()]
        side_type, cell_type = self.types()
        elements = [(side_type, 1, side) for side in self.lower]
        elements += [(side_type, 2, side) for side in self.others]
        elements += [(cell_type, 10, cell) for cell in self.cells]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        for number, (kind, tag, nodes) in enumerate(elements, 1):
            lines.append(" ".join(map(str, [number, kind, 2, tag, tag, *nodes])))
        return lines + ["$EndElements"]


class Damage:
    """Changes the lines of a mesh; says whether it is invalid for sure."""

    def __init__(self, case, lines):
        self.case, self.rng, self.lines = case, case.rng, list(lines)
        self.is_41 = lines[1].startswith("4.1")

    def section(self, name):
        """First line within a section, and the one that ends it."""
        return (self.lines.index("$" + name) + 1, self.lines.index("$End" + name))

    def node_lines(self):
        """Lines with coordinates."""
        first, last = self.section("Nodes")
        n = int(self.lines[first].split()[1 if self.is_41 else 0])
        return range(last - n, last)

    def element_lines(self):
        first, last = self.section("Elements")
        return [k for k in range(first + 1, last)
                if len(self.lines[k].split()) != 4 or not self.is_41]

    def replace_word(self, line, word, value):
        words = self.lines[line].split()
        words[word] = str(value)
        self.lines[line] = " ".join(words)

    def text(self):
        return "\n".join(self.lines) + "\n"

    def none(self):
        return self.text(), False

    def header(self):
        ours = self.lines[1].split()[0]
        value = self.rng.choice(["5.0", "9.9", "abc", "-1", "", "nan", "1e400",
                                 "2.2" if self.is_41 else "4.1"])
        self.lines[1] = self.lines[1].replace(ours, value, 1)
        return self.text(), True

    def binary(self):
        self.replace_word(1, 1, 1)
        return self.text(), True

    def counts(self):
        name = self.rng.choice(["Nodes", "Elements"])
        first, _ = self.section(name)
        words = self.lines[first].split()
        k = self.rng.randrange(len(words)) if self.is_41 else 0
        # Only the numbers of blocks and of things are read for sure.
        count = int(words[k])
        value = self.rng.choice([-1, count + 1, count + 1000, 2 ** 31 - 1, 2 ** 31,
                                 2 ** 32, 2 ** 63, 10 ** 30, "abc", "nan", "1e9"])
        self.replace_word(first, k, value)
        return self.text(), not self.is_41 or k < 2

    def small_counts(self):
        first, _ = self.section(self.rng.choice(["Nodes", "Elements"]))
        k = self.rng.randrange(2) if self.is_41 else 0
        count = int(self.lines[first].split()[k])
        self.replace_word(first, k, self.rng.choice([0, 1, count // 2, count - 1])
                          if count > 1 else 0)
        return self.text(), True

    def node_tag_missing(self):
        """An element has a node that is not there."""
        line = self.rng.choice(self.element_lines())
        self.replace_word(line, -1, self.rng.choice([0, -1, 10 ** 6, 2 ** 31, 2 ** 40,
                                                     "x", "nan", "1.5"]))
        return self.text(), True

    def node_repeated(self):
        """Two vertices of a cell are one."""
        lines = self.element_lines()
        most = max(len(self.lines[k].split()) for k in lines)
        line = self.rng.choice([k for k in lines
                                if len(self.lines[k].split()) == most])
        self.replace_word(line, -1, self.lines[line].split()[-2])
        return self.text(), True

    def nodes_exchanged(self):
        line = self.rng.choice(self.element_lines())
        words = self.lines[line].split()
        words[-1], words[-2] = words[-2], words[-1]
        self.lines[line] = " ".join(words)
        return self.text(), False

    def element_type(self):
        value = self.rng.choice([0, -1, 1, 2, 3, 4, 5, 6, 7, 11, 15, 99, 10 ** 10, "x"])
        if self.is_41:
            first, last = self.section("Elements")
            line = self.rng.choice([k for k in range(first + 1, last)
                                    if k - 1 == first or
                                    k not in self.element_lines()] or [first + 1])
            self.replace_word(line, 2, value)
        else:
            self.replace_word(self.rng.choice(self.element_lines()), 1, value)
        return self.text(), False

    def coordinates(self):
        line = self.rng.choice(self.node_lines())
        value = self.rng.choice(["nan", "inf", "-inf", "1e308", "-1e308", "1e400",
                                 "abc", "1e", ""])
        self.replace_word(line, self.rng.choice([-1, -2, -3]), value)
        # A cell so large is no body; the number itself is one.
        return self.text(), "e308" not in value

    def truncated(self):
        text = self.text()
        cut = self.rng.randrange(len(text))
        return text[:cut], cut < .95 * len(text)

    def byte_flips(self):
        data = bytearray(self.text().encode())
        for _ in range(self.rng.choice([1, 2, 10, 100])):
            data[self.rng.randrange(len(data))] ^= 1 << self.rng.randrange(8)
        return bytes(data), False

    def lines_deleted(self):
        for _ in range(self.rng.choice([1, 1, 3])):
            del self.lines[self.rng.randrange(len(self.lines))]
        return self.text(), False

    def lines_repeated(self):
        k = self.rng.randrange(len(self.lines))
        self.lines.insert(k, self.lines[k])
        return self.text(), False

    def section_gone(self):
        name = self.rng.choice(["Nodes", "Elements"] + ["Entities"] * self.is_41)
        first, last = self.section(name)
        del self.lines[first - 1:last + 1]
        return self.text(), True

    def below(self):
        for line in self.node_lines():
            z = float(self.lines[line].split()[-1])
            self.replace_word(line, -1, repr(z - 50))
        return self.text(), True

    def flat(self):
        """All cells have lost their volume."""
        for line in self.node_lines():
            self.replace_word(line, -1, 2)
        return self.text(), True

    def no_surface_one(self):
        if self.is_41:
            first, _ = self.section("Entities")
            self.lines[first + 1] = self.lines[first + 1].replace("1 1 0", "1 3 0")
        else:
            for line in self.element_lines():
                words = self.lines[line].split()
                if words[3] == "1" and int(words[1]) in (TRIANGLE, QUADRANGLE):
                    words[3] = words[4] = "3"
                self.lines[line] = " ".join(words)
        return self.text(), True

    def nothing(self):
        return self.rng.choice(["", "\n", "$MeshFormat\n", "\0" * 1000,
                                "solid x\nendsolid x\n"]), True


DAMAGES = ("none header header binary counts counts counts small_counts "
           "small_counts node_tag_missing node_tag_missing node_repeated "
           "nodes_exchanged element_type element_type coordinates coordinates "
           "truncated truncated byte_flips byte_flips byte_flips lines_deleted "
           "lines_deleted lines_repeated section_gone below flat no_surface_one "
           "nothing").split()


def original(case):
    """The lines of a good mesh: the real one, or a small box in either format."""
    rng = case.rng
    if rng.random() < .4:
        file = case.context.root / "meshes" / "sphere_h4.msh"
        return file.read_text().splitlines()
    box = Box(rng.choice([1, 2, 3]), tetrahedra=rng.random() < .5)
    return box.format_41() if rng.random() < .6 else box.format_22()


def run(case):
    rng = case.rng
    name = rng.choice(DAMAGES)
    case.note(name)
    text, sure = getattr(Damage(case, original(case)), name)()
    file = case.write("mesh.msh", text)
    if rng.random() < .02:
        file, sure = rng.choice([case.folder, "missing.msh", "/dev/null"]), True
    expected = NOT_ACCEPTED if sure else ACCEPTED if name == "none" else ANY
    settings = {"Mesh/File": file, "Mesh/Degree": "1", "Time/Final time": "0.5",
                "Output/Fields every": "1"}
    validate = rng.random() < .7
    case.attempt("sphere", settings, expected, is_run=not validate,
                 options=["--validate"] if validate else [])
