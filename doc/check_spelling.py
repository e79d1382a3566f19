#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check the spelling of the site's prose with aspell, British English.

    doc/check_spelling.py output/doc

Code and formulas are left out, and so is the API. doc/words.txt has the words that aspell does
not know: names, and terms of the field; one on a line, in order.
"""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys

import html_text

WORDS = pathlib.Path(__file__).resolve().parent / "words.txt"
# Pages that show files and lists, and no prose.
LEFT_OUT = ("api/", "files/", "genindex.html", "search.html")


def unknown(text: str) -> set[str]:
    """The words of a text that aspell does not know."""
    # Names of files, of columns and the like are no words.
    text = text.replace("’", "'")
    text = re.sub(r"\S*[_/=\\@]\S*|\S*\.\w+\b|\w*\d\w*", " ", text)
    answer = subprocess.run(
        ["aspell", "list", "--lang=en_GB", "--encoding=utf-8", "--ignore=2"],
        input=text, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return set(answer.stdout.split())


def known() -> set[str]:
    lines = WORDS.read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    words = known()
    lower = {word.lower() for word in words}
    pages = [
        path
        for path in sorted(folder.rglob("*.html"))
        if not path.relative_to(folder).as_posix().startswith(LEFT_OUT)
    ]
    prose = {path: html_text.read(path).prose for path in pages}
    everywhere = unknown("\n".join(prose.values()))
    wrong = {
        word
        for word in everywhere
        if word not in words and word.lower().removesuffix("'s") not in lower
    }
    for word in sorted(wrong, key=str.lower):
        places = [
            path.relative_to(folder).as_posix()
            for path, text in prose.items()
            if re.search(rf"(?<!\w){re.escape(word)}(?!\w)", text)
        ]
        print(f"{word}: {', '.join(places[:3])}", file=sys.stderr)
    n_words = sum(len(text.split()) for text in prose.values())
    print(f"{n_words} words on {len(pages)} pages, {len(wrong)} of them unknown")
    return 1 if wrong or not n_words else 0


if __name__ == "__main__":
    sys.exit(main())
