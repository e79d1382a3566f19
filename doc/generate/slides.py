# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slides for lectures: one page of HTML, with each picture of the gallery and its caption."""

from __future__ import annotations

from . import figures, site, text

PAGE = f"{figures.FOLDER}/slides"

# One slide fills the window, or a sheet of paper; keys change it, and its number is in the address.
HEAD = """<!DOCTYPE html>
<html lang="en-GB">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Ricochet: slides</title>
<style>
@page { size: 297mm 167mm; margin: 0; }
body { margin: 0; font: 2vmin/1.4 sans-serif; color: #222; background: white; }
section { box-sizing: border-box; width: 100vw; height: 100vh; padding: 3vmin 5vmin; display: none;
  grid-template-rows: auto minmax(0, 1fr) auto auto; gap: 1.5vmin; }
section:target, body.first section:first-of-type { display: grid; }
h1 { margin: 0; font-size: 3.6vmin; }
p { margin: 0; }
img { width: 100%; height: 100%; object-fit: contain; }
footer { color: #777; font-size: 1.6vmin; }
.title { align-content: center; grid-template-rows: none; }
.title h1 { font-size: 7vmin; }
@media print {
  body { font-size: 3.2mm; }
  section, section:target { display: grid; width: 297mm; height: 166mm; padding: 6mm 10mm;
    break-after: page; break-inside: avoid; }
  h1 { font-size: 6mm; } footer { font-size: 2.6mm; } .title h1 { font-size: 12mm; }
}
</style>
</head>
<body class="first">
<article>
"""
TAIL = """</article>
<script>
"use strict";
const slides = [...document.querySelectorAll("section")];
const current = () => Math.max(0, slides.findIndex(slide => "#" + slide.id == location.hash));
function show(number) {
  location.hash = slides[Math.min(Math.max(number, 0), slides.length - 1)].id;
}
addEventListener("hashchange", () => document.body.classList.toggle("first", current() == 0));
addEventListener("keydown", event => {
  const by = {ArrowRight: 1, PageDown: 1, " ": 1, ArrowLeft: -1, PageUp: -1}[event.key];
  if (by || event.key == "Home" || event.key == "End") {
    event.preventDefault();
    show(by ? current() + by : event.key == "Home" ? 0 : slides.length - 1);
  }
});
addEventListener("click", event => show(current() + (event.clientX < innerWidth / 3 ? -1 : 1)));
if (location.hash) dispatchEvent(new Event("hashchange"));
</script>
</body>
</html>
"""


def deck(gallery: figures.Gallery) -> str:
    """All slides: a title, the pictures that are made, and the names of those that are not."""
    entries = [entry for entry in gallery.entries if entry.figure.image]
    made = [entry for entry in entries if gallery.has_picture(entry)]
    missing = [entry.name for entry in entries if not gallery.has_picture(entry)]
    slides = [
        '<section id="title" class="title"><h1>Ricochet</h1>\n<p>Dynamic contact: '
        f"{len(made)} figures. Keys: right and left, Home and End; to print them as PDF, use the "
        "browser's print command.</p></section>"
    ]
    for entry in made:
        figure = entry.figure
        slides.append(
            f'<section id="{entry.anchor}"><h1>{text.escape(figure.title)}</h1>\n'
            f'<div><img src="pictures/{figure.image}" alt="{text.escape(figure.title)}"></div>\n'
            f"<p>{text.escape(figure.caption)}</p>\n"
            f"<footer>{entry.name}, computed by {', '.join(entry.programs)}</footer></section>"
        )
    if missing:
        slides.append(
            '<section id="missing" class="title"><h1>Not made</h1>\n<p>These pictures were not '
            f"there when the slides were made: {', '.join(missing)}. "
            "<code>figures/make.py NAME</code> makes one of them.</p></section>"
        )
    return HEAD + "\n".join(slides) + "\n" + TAIL


def make(made: site.Site, gallery: figures.Gallery) -> None:
    """Write the slides, beside the pages of the gallery."""
    made.extra(f"{PAGE}.html").write_text(deck(gallery), encoding="utf-8")
