# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prose of source files: comments of C++ and parameter files, comments and docstrings of Python,
paragraphs of Markdown."""

from __future__ import annotations

import ast
import io
import pathlib
import re
import tokenize

# Strings and characters first, since they may contain what looks like a comment.
CPP = re.compile(
    r'R"(?P<mark>\w*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])'"
    r"|(?P<line>//[^\n]*)|(?P<block>/\*.*?\*/)",
    re.DOTALL,
)
LITERALS = re.compile(r'(?:"(?:\\.|[^"\\\n])*"\s*)+')
# A line of Markdown or of a docstring with which a paragraph begins.
BEGINNING = re.compile(r"[-*] |\d+\. |\||#|@|\\")


def paragraphs(lines: list[str]) -> list[tuple[int, str]]:
    """Paragraphs of some lines, each with the index of its first line."""
    found: list[list] = []
    is_open = False
    for index, line in enumerate(lines):
        words = " ".join(line.split())
        if not words:
            is_open = False
        elif is_open and not BEGINNING.match(words):
            found[-1][1] += " " + words
        else:
            found.append([index, words])
            is_open = True
    return [(index, text) for index, text in found]


def cpp(text: str) -> list[str]:
    """Comments of C++, in place: the words of comments on their lines, and nothing else."""
    lines = [""] * (text.count("\n") + 1)
    for match in CPP.finditer(text):
        first = text.count("\n", 0, match.start())
        if match["line"]:
            lines[first] = re.sub(r"^//[/!]?<?", "", match["line"])
        elif match["block"]:
            for index, line in enumerate(match["block"].removesuffix("*/").split("\n")):
                lines[first + index] = re.sub(r"^\s*/?\*+[!<]*", "", line)
    return lines


def messages(text: str) -> list[tuple[int, str]]:
    """Literals of C++ with several words, each with its line; adjacent ones are one."""
    found = []
    for match in LITERALS.finditer(CPP.sub(lambda each: _without_comment(each[0]), text)):
        words = "".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', match[0]))
        if words.count(" ") > 1:
            found.append((text.count("\n", 0, match.start()) + 1, words))
    return found


def _without_comment(token: str) -> str:
    """A string as it is, a comment as blanks."""
    return token if token[0] in "\"'R" else re.sub(r"[^\n]", " ", token)


def python(text: str) -> list[str]:
    """Comments and docstrings of Python, in place."""
    lines = [""] * (text.count("\n") + 2)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, documented) and ast.get_docstring(node) is not None:
            string = node.body[0]
            for index, line in enumerate(string.value.value.split("\n")):
                lines[string.lineno - 1 + index] = line
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            lines[token.start[0] - 1] = re.sub(r"^#[:!]?\s*", "", token.string)
    return lines


def markdown(text: str) -> list[str]:
    """Markdown without its blocks of code, in place."""
    code = re.compile(r"^\s*(```|~~~).*?^\s*\1", re.DOTALL | re.MULTILINE)
    return code.sub(lambda match: "\n" * match[0].count("\n"), text).split("\n")


def parameter_file(text: str) -> list[str]:
    """Comments of a parameter file, in place."""
    return [line.partition("#")[2] for line in text.split("\n")]


READERS = {".cc": cpp, ".h": cpp, ".py": python, ".md": markdown, ".prm": parameter_file}


def read(path: pathlib.Path) -> list[tuple[int, str]]:
    """Paragraphs of a file's prose, each with the number of its first line."""
    lines = READERS[path.suffix](path.read_text(encoding="utf-8"))
    return [(index + 1, text) for index, text in paragraphs(lines)]
