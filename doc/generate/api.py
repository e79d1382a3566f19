# SPDX-License-Identifier: LGPL-2.1-or-later
"""The documentation of the library's classes, by Doxygen."""

from __future__ import annotations

import pathlib
import re
import subprocess

from . import site

FOLDER = "api"


def address(file: str) -> str:
    """The page that shows a header of lib/, named as in the checkout."""
    name = pathlib.PurePosixPath(file).name
    return f"{FOLDER}/{name.replace('_', '__').replace('.', '_8')}_source.html"


def make(output: pathlib.Path, work: pathlib.Path) -> list[str]:
    """Write the pages to `output`/api. Returns the warnings.

    Raises:
        SiteError: Doxygen failed.
    """
    work.mkdir(parents=True, exist_ok=True)
    warnings = work / "doxygen.log"
    settings = (site.DOC / "api" / "Doxyfile").read_text(encoding="utf-8")
    version = re.search(
        r"project\(Ricochet VERSION (\S+)", (site.ROOT / "CMakeLists.txt").read_text()
    )
    settings += (
        f'\nOUTPUT_DIRECTORY = "{output}"\nHTML_OUTPUT = {FOLDER}\n'
        f'WARN_LOGFILE = "{warnings}"\nPROJECT_NUMBER = {version[1] if version else ""}\n'
    )
    answer = subprocess.run(
        ["doxygen", "-"], input=settings, text=True, cwd=site.ROOT, capture_output=True, check=False
    )
    if answer.returncode != 0:
        raise site.SiteError(f"Doxygen failed:\n{answer.stderr}")
    _mend_links(output / FOLDER)
    found = warnings.read_text(encoding="utf-8").replace(f"{site.ROOT}/", "")
    return [line for line in found.splitlines() if line.strip()]


def remove_links(folder: pathlib.Path) -> None:
    """Keep the words of links to the API, in a site without it."""
    for path in folder.rglob("*.html"):
        content = path.read_text(encoding="utf-8")
        if f"{FOLDER}/" in content:
            link = rf'<a [^>]*href="(?:\.\./)*{FOLDER}/[^"]*"[^>]*>(.*?)</a>'
            path.write_text(re.sub(link, r"\1", content, flags=re.DOTALL), encoding="utf-8")


def _mend_links(folder: pathlib.Path) -> None:
    """Doxygen 1.9 leads to lists of private classes that it does not write."""
    for path in folder.glob("*.html"):
        content = path.read_text(encoding="utf-8")
        if '"#nested-classes"' in content and 'name="nested-classes"' not in content:
            content = re.sub(r'<a href="#nested-classes">.*?</a>(?: &#124;)?', "", content)
            path.write_text(content, encoding="utf-8")


def not_known(warnings: list[str]) -> list[str]:
    """The warnings that are not in doc/api/known_warnings.txt."""
    path = site.DOC / "api" / "known_warnings.txt"
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    known = [line for line in lines if line and not line.startswith("#")]
    # Numbers of lines change with every edit.
    return [
        warning
        for warning in warnings
        if not any(re.sub(r":\d+:", ":", warning).startswith(line) for line in known)
    ]
