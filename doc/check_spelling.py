#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check the spelling of the site's prose with aspell, British English, and its idioms.

    doc/check_spelling.py output/doc          spelling and idioms of the site
    doc/check_spelling.py --sources [ROOT]    idioms of the sources: comments, docstrings,
                                              messages and Markdown; seconds, without a site

Code and formulas are left out, and so is the API. doc/words.txt has the words that aspell does
not know: names, and terms of the field; one on a line, in order. doc/idioms.txt has the idioms
that are refused, with the words to use instead.
"""

from __future__ import annotations

import functools
import pathlib
import re
import subprocess
import sys

import html_text
import source_text

HERE = pathlib.Path(__file__).resolve().parent
WORDS = HERE / "words.txt"
IDIOMS = HERE / "idioms.txt"
# Pages that show files and lists, and no prose.
LEFT_OUT = ("api/", "files/", "genindex.html", "search.html")
# Pages with parts of the change log, whose old entries stay as they are.
HISTORY = ("how_to/speed.html",)
# Folders and files whose idioms are checked.
SOURCES = (
    ".github", "CODE_OF_CONDUCT.md", "CONTRIBUTING.md", "README.md", "SECURITY.md", "benchmarks",
    "doc", "examples", "figures", "lib", "packaging", "paper", "parameter_files", "python",
    "scripts", "steps", "tests",
)  # fmt: skip


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


@functools.cache
def idioms() -> list[tuple[re.Pattern[str], str]]:
    """The expressions of doc/idioms.txt, each with the words to use instead."""
    found = []
    for line in IDIOMS.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            expression, instead = line.split("\t")
            flags = 0 if expression.startswith("^") else re.IGNORECASE
            found.append((re.compile(expression, flags), instead))
    return found


def findings(text: str, is_comment: bool) -> list[str]:
    """The idioms in a paragraph, each with the words to use instead.

    is_comment: expressions for the beginning of comments apply, those for users do not.
    """
    return [
        f"'{match[0]}': {instead}"
        for expression, instead in idioms()
        if not expression.pattern.startswith("(?#user)" if is_comment else "^")
        for match in expression.finditer(text)
    ]


def check_sources(root: pathlib.Path) -> int:
    """Report the idioms of the sources. Returns their number."""
    number = n_files = 0
    for name in SOURCES:
        top = root / name
        for path in [top] if top.is_file() else sorted(top.rglob("*")):
            if path.suffix not in source_text.READERS:
                continue
            n_files += 1
            is_code = path.suffix in (".cc", ".h", ".py")
            found = [(line, text, is_code) for line, text in source_text.read(path)]
            if name in ("lib", "steps") and path.suffix in (".cc", ".h"):
                content = path.read_text(encoding="utf-8")
                found += [(*each, False) for each in source_text.messages(content)]
            for line, text, is_comment in sorted(found):
                for finding in findings(text, is_comment):
                    print(f"{path.relative_to(root)}:{line}: {finding}", file=sys.stderr)
                    number += 1
    print(f"{n_files} source files, {number} idioms")
    return number


def main() -> int:
    if sys.argv[1:2] == ["--sources"] and len(sys.argv) <= 3:
        root = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE.parent
        return 1 if check_sources(root) else 0
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
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
    n_idioms = 0
    for path, text in prose.items():
        page = path.relative_to(folder).as_posix()
        if page not in HISTORY:
            for finding in findings(" ".join(text.split()), is_comment=False):
                print(f"{page}: {finding}", file=sys.stderr)
                n_idioms += 1
    n_words = sum(len(text.split()) for text in prose.values())
    print(
        f"{n_words} words on {len(pages)} pages, {len(wrong)} of them unknown; {n_idioms} idioms"
    )
    return 1 if wrong or n_idioms or not n_words else 0


if __name__ == "__main__":
    sys.exit(main())
