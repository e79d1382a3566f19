#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check that all links within the site lead somewhere.

    doc/check_links.py output/doc

Files, and anchors in them. Addresses of other sites are not requested.
"""

from __future__ import annotations

import pathlib
import sys
import urllib.parse

import html_text


def broken_links(folder: pathlib.Path) -> tuple[int, list[str]]:
    """How many links there are within the site, and those that lead nowhere."""
    folder = folder.resolve()
    pages = {path: html_text.read(path) for path in sorted(folder.rglob("*.html"))}
    count, broken = 0, []
    for path, page in pages.items():
        for link in dict.fromkeys(page.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            target = path
            if parts.path:
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve()
            if target.is_dir():
                target = target / "index.html"
            anchor = urllib.parse.unquote(parts.fragment)
            where = f"{path.relative_to(folder)}: {link}"
            if folder not in target.parents:
                broken.append(f"{where} leads out of the site")
            elif not target.is_file():
                broken.append(f"{where}: there is no such file")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                broken.append(f"{where}: there is no such place in the page")
    return count, broken


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    count, broken = broken_links(pathlib.Path(sys.argv[1]))
    for line in broken:
        print(line, file=sys.stderr)
    print(f"{count} links within the site, {len(broken)} of them broken")
    return 1 if broken or not count else 0


if __name__ == "__main__":
    sys.exit(main())
