# SPDX-License-Identifier: LGPL-2.1-or-later
"""Material for lecturers: the commands and numbers of the course (doc/teaching/course.md), the page
of what is conserved, and the slides."""

import csv
import html
import json
import math
import re
import shlex

from common import *

sys.path.insert(0, str(ROOT / "doc"))

COURSE = ROOT / "doc" / "teaching" / "course.md"
BROWSER = shutil.which("chromium")

try:
    import make_cheat_sheet
    from generate import figures, how_to, site, slides
    from matplotlib import pyplot
except ImportError:
    pyplot = None

# Keys of a user, and the slide that is to be seen after each of them.
QUESTIONS = """<script>
const seen = [];
(async () => {
  for (const key of ["", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowLeft", "Home"]) {
    dispatchEvent(new KeyboardEvent("keydown", {key}));
    await new Promise(resolve => setTimeout(resolve, 50));
    seen.push(slides.filter(each => getComputedStyle(each).display != "none").map(each => each.id));
  }
  const pre = document.createElement("pre");
  pre.id = "answer";
  pre.textContent = JSON.stringify(seen);
  document.body.append(pre);
})();
</script></body>"""


def signed(value, form):
    """A number with the minus sign of the page."""
    return format(value, form).replace("-", "−")


@unittest.skipIf(pyplot is None, "matplotlib is missing")
class Course(ProgramTest):
    def commands(self, unit):
        """The commands of a unit, with this test's folder for the output."""
        text = COURSE.read_text().split("\n## Unit ")[unit]
        lines = re.findall(r"^(?:build/release/|python/bin/|for \w+ in ).*", text, re.MULTILINE)
        self.assertGreater(len(lines), 1)
        for line in lines:
            line = line.replace("output/course", str(self.folder))
            if line.startswith("for "):
                yield ["bash", "-ec", line.replace("build/release", program_path(""))]
                continue
            words = shlex.split(line)
            if words[0].startswith("build/"):
                words[0] = program_path(pathlib.Path(words[0]).name)
            else:
                words += ["--programs", program_path("")]
                words.insert(0, sys.executable)
            yield words

    def run_unit(self, unit, last=None):
        for words in list(self.commands(unit))[:last]:
            result = subprocess.run(
                [str(self.folder / "mine.prm") if word == "mine.prm" else word for word in words],
                cwd=ROOT, capture_output=True, text=True, timeout=600)
            self.assertEqual(result.returncode, 0, msg=result.stdout + result.stderr)

    def check_words(self, *words):
        """The page says these words."""
        page = COURSE.read_text()
        self.assertEqual([each for each in words if each not in page], [])

    def check_table(self, unit, rows):
        """These rows are those of the page, cell by cell."""
        marks = f"<!-- unit {unit}: begin -->(.*?)<!-- unit {unit}: end -->"
        table = re.search(marks, COURSE.read_text(), re.DOTALL)[1].strip().splitlines()[2:]
        self.assertEqual(table, ["| " + " | ".join(row) + " |" for row in rows])

    def test_unit_1(self):
        self.run_unit(1)
        spring, conserving = (Ledger(self.folder / name) for name in ("spring", "conserving"))
        x = [-gap for gap in spring["displacement_left"]]
        rows, changes, rest = [], [], []
        for time, old, new, change in zip(spring["time"][1:], x, x[1:],
                                          increments(spring["modified_energy"])):
            if (old > 0.) == (new > 0.):
                rest.append(change)
                continue
            by_hand = 50. * old * new * (1. if new > 0. else -1.)
            self.assertAlmostEqual(change, by_hand, delta=1e-15)
            changes.append(change)
            rows.append([f"{time:.2f}", "begins" if new > 0. else "ends",
                         *(signed(1e3 * value, ".3f") for value in (old, new)),
                         signed(1e3 * change, ".4f")])
        self.check_table(1, rows)
        self.assertLess(largest(rest), 2e-16)
        lost = 1e3 * sum(change for change in changes if change < 0.)
        gained = 1e3 * sum(change for change in changes if change > 0.)
        self.check_words(f"2\\. {-lost:.4f} mJ are lost and {gained:.4f} mJ gained: "
                         f"{-100. * (lost + gained) / 125.:.1f} %")
        self.assertLess(largest(conserving["total_energy"][k] / .125 - 1.
                                for k in range(len(conserving["time"]))), 1e-12)

    def test_course_for_students(self):
        """All questions and sheets, and no answer."""
        course = COURSE.read_text()
        students = how_to.without_answers(course)
        for mark in ("## Unit ", "**Questions:**", "**Sheet:**", "\nbuild/release/"):
            self.assertEqual(students.count(mark), course.count(mark))
        for word in ("Answers", "2.6106", "0.3494", "keeps | 0.00", "set Probe ball"):
            self.assertNotIn(word, students)

    def test_unit_2(self):
        self.run_unit(2)
        log = (self.folder / "orders" / "log.txt").read_text()
        rows = []
        for scheme in ("Crank-Nicolson", "TR-BDF2"):
            errors, energies = [], []
            for h, mass in (("0.05", "consistent"), ("0.025", "consistent"),
                            ("0.0125", "consistent"), ("0.0125", "redistributed")):
                folder = self.folder / f"{scheme}_{h}"
                if mass == "redistributed":
                    folder = self.folder / "run"
                    self.run_program("bar_sd", [
                        f"Time/Scheme={scheme}", f"Mesh/Mesh size={h}", f"Time/Time step={h}",
                        f"Time/Mass={mass}", *NO_FIELDS])
                ledger = Ledger(folder)
                said = (folder / "log.txt").read_text()
                errors.append(float(re.search(r"H1\) error: ([^,]+)", said)[1]))
                energy = ledger["modified_energy"]
                energies.append(signed(100. * (energy[-1] / energy[0] - 1.), "+.2f") + " %")
            orders = [f"{math.log2(old / new):.2f}" for old, new in zip(errors[:2], errors[1:])]
            order = re.search(rf" {scheme} order +([\d.]+)", log)[1]
            rows.append([scheme, *(f"{error:.4f}" for error in errors[:3]), ", ".join(orders),
                         order, ", ".join(energies[:3])])
            self.check_words(f"{errors[3]:.4f} with {scheme}")
        self.check_table(2, rows)

    def test_unit_3(self):
        """Its first command only; the second one takes as long."""
        self.run_unit(3, last=1)
        with open(self.folder / "treatments" / "table.csv", newline="") as file:
            table = list(csv.DictReader(file))
        said = make_cheat_sheet.promises(pathlib.Path(program_path("ricochet")))

        def scatter(row, name, form):
            mean, least, most = (float(row[f"{which} {name}"])
                                 for which in ("mean", "smallest", "largest"))
            return f"{abs(mean):{form}} ± {.5 * (most - least):{form}}"

        self.check_table(3, [
            [row["method"], said[row["method"]][0], scatter(row, "energy lost (%)", ".2f"),
             scatter(row, "restitution", ".3f"),
             f"{1e3 * float(row['mean largest penetration (m)']):.2f}"] for row in table])

    def test_unit_4(self):
        scene = re.search(r"^The file:\n\n```\n(.*?)```", COURSE.read_text(),
                          re.DOTALL | re.MULTILINE)[1]
        (self.folder / "mine.prm").write_text(scene)
        self.run_unit(4)
        # By hand, as in the head of the example.
        belt, g, omega = .2, 9.81, 6.
        a, weight = .3 * g, 10. * g
        t = math.asin(omega * belt / a) / omega
        x = a / omega**2 * (1. - math.cos(omega * t))
        heat = .3 * weight * (belt * t - x + belt * 2. * math.pi / omega)
        run = Ledger(self.folder / "belt")
        at = run["block_displacement_x"]
        speed = run["motion_of_block_velocity_x"]
        sticks = next(k for k, v in enumerate(speed) if v > .9999 * belt)
        top = at.index(max(at))
        rows = [
            ["block sticks at", f"{t:.4f} s, {1e3 * x:.2f} mm",
             f"{run['time'][sticks]:.3f} s, {1e3 * at[sticks]:.2f} mm"],
            ["block swings from, to", ", ".join(f"{1e3 * (a / omega**2 + sign * belt / omega):.2f}"
                                                for sign in (-1., 1.)) + " mm",
             f"{1e3 * min(at[top:]):.2f}, {1e3 * max(at):.2f} mm"],
            ["heat", f"{heat:.3f} J", f"{run['friction_work'][-1]:.3f} J"]]
        run = Ledger(self.folder / "mine")
        speed, momentum, time = run["ball_velocity_y"], run["momentum_y"], run["time"]
        touches = [k for k, force in enumerate(run["contact_force_floor"]) if force > 0.]
        first, last = touches[0] - 1, touches[-1] + 1
        mass = momentum[first] / speed[first]
        impulse = momentum[-1] + mass * g * time[-1]
        self.assertAlmostEqual(run["impulse_y_floor"][-1], impulse, delta=1e-10)
        self.assertLess(largest(energy - run["total_energy"][0] for energy in run["total_energy"]),
                        2e-12)
        rows += [
            ["velocity of the disk at the floor", f"{math.sqrt(.4 * g):.3f} m/s",
             f"{-speed[first]:.3f} m/s"],
            ["time of its first contact", f"{math.sqrt(.4 / g):.4f} s", f"{time[first + 1]:.3f} s"],
            ["impulse of the floor", f"{impulse:.2f} N s", f"{run['impulse_y_floor'][-1]:.2f} N s"]]
        self.check_table(4, rows)
        centre = .5 * mass * speed[last]**2
        elastic = run["elastic_energy"][last]
        self.check_words(
            f"leaves with {-speed[last] / speed[first]:.3f} of its speed",
            f"work of {run['external_work'][last]:.1f} J, of which {centre:.1f} J",
            f"{elastic:.1f} J are `elastic_energy`",
            f"remaining {run['kinetic_energy'][last] - centre:.1f} J", f"{mass:.2f} kg")


@unittest.skipIf(pyplot is None, "matplotlib is missing")
class Sheets(ProgramTest):
    def test_cheat_sheet(self):
        """One page A4 with each treatment, promise and scheme, as text that can be searched."""
        path, program = self.folder / "sheet.pdf", pathlib.Path(program_path("ricochet"))
        make_cheat_sheet.write(program, path)
        content = path.read_bytes()
        self.assertIn(b"/Count 1 ", content)
        width, height = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", content).groups()
        self.assertAlmostEqual(float(width) / 72. * 25.4, 297., delta=.1)
        self.assertAlmostEqual(float(height) / 72. * 25.4, 210., delta=.1)
        texts = [text.decode("cp1252") for text in re.findall(rb"\((.*?)\)\sTj", content)]
        said = make_cheat_sheet.promises(program)
        self.assertGreater(len(said), 20)
        for name, (promise, _) in said.items():
            with self.subTest(name):
                self.assertIn(promise, texts)
                if name.startswith("any "):
                    self.assertTrue(any(text.startswith(f"{name}: {promise}") for text in texts))
                else:
                    self.assertEqual(texts[texts.index(name) + 1], promise)

    @unittest.skipIf(BROWSER is None, "there is no browser (Debian's chromium)")
    def test_slides(self):
        """Pictures that are there have a slide, the others a name; keys change the slide."""
        pictures = self.folder / "output" / "figures"
        pictures.mkdir(parents=True)
        for name in ("C-6.png", "C-9.png"):
            pyplot.figure(figsize=(2, 1)).savefig(pictures / name)
        pyplot.close("all")
        made = site.Site(self.folder, self.folder / "pages", self.folder / "output")
        gallery = figures.Gallery(made, kept=self.folder / "none")
        slides.make(made, gallery)
        path = made.extra(f"{slides.PAGE}.html")
        page = path.read_text()
        self.assertEqual(re.findall(r'<img src="pictures/(.*?)"', page), ["C-6.png", "C-9.png"])
        for name in ("C-6.png", "C-9.png"):
            self.assertTrue((path.parent / "pictures" / name).is_file())
        missing = re.search(r'<section id="missing".*', page, re.DOTALL)[0]
        for entry in gallery.entries:
            if entry.figure.image and entry.name not in ("C-6", "C-9"):
                self.assertRegex(missing, rf"\b{entry.name}[,.]")
        path.write_text(page.replace("</body>", QUESTIONS))
        result = subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
             "--no-first-run", "--disable-background-networking", "--disable-component-update",
             "--disable-sync", f"--user-data-dir={self.folder / 'browser'}",
             "--virtual-time-budget=5000", "--dump-dom", f"file://{path}"],
            capture_output=True, text=True, timeout=120)
        answer = re.search(r'<pre id="answer">(.*?)</pre>', result.stdout, re.DOTALL)[1]
        self.assertEqual(json.loads(html.unescape(answer)),
                         [["title"], ["figure-c-6"], ["figure-c-9"], ["missing"], ["figure-c-9"],
                          ["title"]])


if __name__ == "__main__":
    main()
