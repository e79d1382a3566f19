# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a run (ricochet-plot --html), in a real browser without a screen: positions against
the VTU files, pictures, the slider, and what is refused; and fields at the nodes as arrays."""

import html
import json

from common import *

PACKAGE = ROOT / "python"
sys.path.insert(0, str(PACKAGE))
BROWSER = shutil.which("chromium")

try:
    import numpy
    import vtk  # noqa: F401
    from ricochet import Run, fields, page
except ImportError:
    numpy = None

SCENE = """
set Program   = ricochet
set Dimension = {dimension}
subsection Body ball
  set Shape         = {shape}
  set Size          = {size}
  set Cells along   = {cells}
  set Translation   = {above}
  set Velocity      = {velocity}
  set Young modulus = 1e5
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface = ball: lower
  set Against = floor
end
subsection Time
  set Final time = 0.02
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 5
end
"""
# Actions of a user, and the page after each of them.
QUESTIONS = """<script>
const answer = {places: [], times: [], colours: []};
for (let k = 0; k < nFrames; ++k) {
  const slider = document.getElementById("slider");
  slider.value = k;
  slider.dispatchEvent(new Event("input"));
  answer.places.push(places(k));
  answer.times.push(document.getElementById("time").textContent);
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let coloured = 0;
  for (let i = 0; i < pixels.length; i += 4)
    coloured += Math.max(pixels[i], pixels[i + 1], pixels[i + 2]) -
      Math.min(pixels[i], pixels[i + 1], pixels[i + 2]) > 40;
  answer.colours.push(coloured / (canvas.width * canvas.height));
}
const plot = document.querySelector("#plots canvas").getBoundingClientRect();
document.querySelector("#plots canvas").dispatchEvent(new PointerEvent("pointerdown",
  {clientX: plot.right - 13, clientY: plot.top + 40, pointerId: 1}));
answer.after_click = frame;
answer.problem = gl.getError();
answer.hidden = document.getElementById("problem").hidden;
const pre = document.createElement("pre");
pre.id = "answer";
pre.textContent = JSON.stringify(answer);
document.body.append(pre);
</script></body>"""


@unittest.skipIf(numpy is None, "NumPy, matplotlib or VTK is missing")
class Page(ProgramTest):
    def make(self, dimension, parameters=()):
        plane = dimension == 2
        scene = self.folder / "scene.prm"
        scene.write_text(SCENE.format(
            dimension=dimension, shape="rectangle" if plane else "block",
            size="0.2, 0.1" if plane else "0.2, 0.1, 0.1", cells="4, 2" if plane else "4, 2, 2",
            above="0, 0.002" if plane else "0, 0, 0.002",
            velocity="0, -0.5" if plane else "0, 0, -0.5"))
        self.run_program("ricochet", parameters, prm=scene)
        return self.plot(self.folder / "run")

    def plot(self, run, *words, code=0):
        result = subprocess.run(
            [sys.executable, str(PACKAGE / "bin" / "ricochet-plot"), str(run), "--html", *words],
            capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, code, msg=result.stdout + result.stderr)
        return result.stderr if code else pathlib.Path(result.stdout.split("\n")[-2])

    def ask_browser(self, path):
        questions = self.folder / "questions.html"
        questions.write_text(path.read_text().replace("</body>", QUESTIONS))
        result = subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             f"--user-data-dir={self.folder / 'browser'}", "--window-size=900,700",
             "--virtual-time-budget=5000", "--dump-dom", f"file://{questions}"],
            capture_output=True, text=True, timeout=120)
        begin = result.stdout.index('<pre id="answer">') + len('<pre id="answer">')
        return json.loads(html.unescape(result.stdout[begin:result.stdout.index("</pre>", begin)]))

    @unittest.skipIf(BROWSER is None, "there is no browser (Debian's chromium)")
    def test_positions_and_pictures(self):
        for dimension in (2, 3):
            with self.subTest(dimension):
                path = self.make(dimension)
                self.assertLess(path.stat().st_size, 10_000_000)
                for word in ("http://", "https://"):
                    self.assertNotIn(word, path.read_text())
                answer = self.ask_browser(path)
                self.assertEqual(answer["problem"], 0)
                self.assertIs(answer["hidden"], True)
                run = Run(self.folder / "run")
                self.assertEqual(len(answer["places"]), len(run.field_files))
                self.assertEqual(answer["after_click"], len(run.field_files) - 1)
                self.assertEqual(answer["times"][1], "t = 0.005 s")
                surface = page.surface_of(run.fields(0))
                n_on_surface = 15 if dimension == 2 else 5 * 3 * 3 - 3
                self.assertEqual(len(surface.first), n_on_surface)
                for places, file in zip(answer["places"], run.field_files):
                    grid = run.fields(file.step)
                    now = (fields.array_of_points(grid) + fields.displacements(grid))
                    found = numpy.array(places).reshape(-1, 3)
                    self.assertLess(numpy.abs(found - now[surface.first]).max(), 1e-4 * .2)
                # Forces of the nodes add up to the columns of the table, in single precision.
                along = "xyz"[dimension - 1]
                column = run.table[f"resultant_{along}_floor"]
                for file in run.field_files:
                    force = run.field("contact_force", file.step)
                    self.assertEqual(force.shape, (len(run.nodes()), 3))
                    self.assertAlmostEqual(force[:, dimension - 1].sum(), column[file.step],
                                           delta=2e-7 * max(column))
                self.assertGreater(max(column), 0.)
                with self.assertRaisesRegex(Exception, "Is 'von_mises' meant?"):
                    run.field("vonmises")
                # The body fills a good part of the picture in each frame.
                self.assertGreater(min(answer["colours"]), .05)
                self.assertLess(max(answer["colours"]), .9)

    def test_what_is_refused(self):
        run = self.folder / "bar"
        self.run_program("bar_sd", ["Time/Final time=0.2", "Output/Fields every=1"], folder=run)
        self.assertIn("has a bar", self.plot(run, code=2))

    def test_bound_on_the_size(self):
        """Frames are left out, at even distances, before the page is too large."""
        path = self.make(2)
        run = Run(self.folder / "run")
        largest, page.LARGEST = page.LARGEST, len(path.read_text()) + 39_000
        try:
            files = page._chosen(run.field_files, 40_000, 0.)
            self.assertLess(len(files), len(run.field_files))
            page.LARGEST = 30_000
            with self.assertRaisesRegex(Exception, "too large for a page"):
                page._chosen(run.field_files, 40_000, 0.)
        finally:
            page.LARGEST = largest


if __name__ == "__main__":
    main()
