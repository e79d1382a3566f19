#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check that pages with formulas fit on a narrow screen, in a browser without a screen.

    doc/check_width.py output/doc [WIDTH]

Neither a page nor a formula may be wider than the screen of WIDTH pixels, 400 unless given.
Without Debian's chromium nothing is checked.
"""

from __future__ import annotations

import html
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

BROWSER = shutil.which("chromium")
# Each page in a frame, four at a time, since windows have at least 500 pixels.
FRAMES = """<!DOCTYPE html><script>
const pages = PAGES, wide = [];
let begun = 0, done = 0;
function next() {
  if (done === pages.length) {
    const answer = document.createElement("pre");
    answer.id = "answer";
    answer.textContent = JSON.stringify(wide);
    document.body.append(answer);
  }
  if (begun === pages.length)
    return;
  const number = begun++;
  const frame = document.createElement("iframe");
  frame.width = WIDTH;
  frame.height = 900;
  frame.src = pages[number];
  frame.onload = () => {
    const page = frame.contentDocument;
    const measure = () => {
      for (const box of [page.documentElement, ...page.querySelectorAll("div.math")])
        if (box.scrollWidth > box.clientWidth + 1) {
          const script = box.querySelector(":scope > script[type^='math']");
          wide.push([number, box.scrollWidth - box.clientWidth,
                     script ? script.textContent : "the page"]);
        }
      frame.remove();
      ++done;
      next();
    };
    const formulas = frame.contentWindow.MathJax;
    formulas ? formulas.Hub.Queue(measure) : measure();
  };
  document.body.append(frame);
}
document.addEventListener("DOMContentLoaded", () => {
  for (let i = 0; i < 4; ++i) next();
});
</script><body></body>"""


def pages_with_formulas(folder: pathlib.Path) -> list[str]:
    return [
        path.relative_to(folder).as_posix()
        for path in sorted(folder.rglob("*.html"))
        if "api" not in path.relative_to(folder).parts
        and 'class="math' in path.read_text(encoding="utf-8", errors="replace")
    ]


def too_wide(folder: pathlib.Path, pages: list[str], width: int) -> list[tuple[str, int, str]]:
    """Pages and formulas that do not fit: the page, by how many pixels, and the formula."""
    frames = FRAMES.replace("WIDTH", str(width)).replace(
        "PAGES", json.dumps([(folder.resolve() / page).as_uri() for page in pages])
    )
    with tempfile.TemporaryDirectory() as work:
        file = pathlib.Path(work) / "frames.html"
        file.write_text(frames, encoding="utf-8")
        result = subprocess.run(
            [str(BROWSER), "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--allow-file-access-from-files", f"--user-data-dir={work}/browser",
             "--virtual-time-budget=600000", "--dump-dom", file.as_uri()],
            capture_output=True, text=True, timeout=300, check=True,
        )  # fmt: skip
    answer = result.stdout.partition('<pre id="answer">')[2].partition("</pre>")[0]
    return [(pages[number], *rest) for number, *rest in json.loads(html.unescape(answer))]


def main() -> int:
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    if BROWSER is None:
        print("widths are not checked: there is no chromium")
        return 0
    folder = pathlib.Path(sys.argv[1])
    pages = pages_with_formulas(folder)
    wide = too_wide(folder, pages, int((sys.argv[2:] or ["400"])[0]))
    for page, excess, formula in wide:
        print(f"{page}: {excess} pixels too wide: {' '.join(formula.split())}", file=sys.stderr)
    print(f"{len(pages)} pages with formulas, {len(wide)} too wide")
    return 1 if wide or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
