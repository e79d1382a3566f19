#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make the tables of doc/combinations.md from the rules in the library.

    doc/make_combinations.py                 # writes them, with build/release/ricochet
    doc/make_combinations.py --build-dir DIR
"""

import argparse
import csv
import itertools
import pathlib
import subprocess

PAGE = pathlib.Path(__file__).resolve().parent / "combinations.md"
BEGIN, END = "<!-- combinations: begin -->\n", "<!-- combinations: end -->\n"

# Choices within a cell, in the order of the columns of the list.
OTHERS = ("mass", "friction", "viscosity", "material", "dimension", "degree")
WORDS = {("mass", "redistributed"): "redistributed mass",
         ("mass", "consistent"): "consistent mass",
         ("friction", "none"): "no friction", ("friction", "Coulomb"): "Coulomb's friction",
         ("friction", "slip-rate dependent"): "slip-rate friction",
         ("viscosity", "yes"): "viscosity", ("viscosity", "no"): "no viscosity",
         ("material", "linear elastic"): "linear elasticity",
         ("material", "hyperelastic"): "hyperelasticity",
         ("dimension", "2"): "2D", ("dimension", "3"): "3D",
         ("degree", "1"): "degree 1", ("degree", "2"): "degree 2"}
CONTACTS = {"obstacle": "Against rigid obstacles",
            "moving obstacle": "Against rigid obstacles that move",
            "points": "Between bodies, points",
            "mortar": "Between bodies, mortar",
            "dual mortar": "Between bodies, dual mortar",
            "cut faces": "Between bodies, cut faces",
            "itself": "A surface against itself"}


def read(program):
    """Rows of the list, and its reasons."""
    text = subprocess.run([str(program), "--combinations"], check=True, capture_output=True,
                          text=True).stdout
    rows, reasons = text.split("\n\n")
    return list(csv.DictReader(rows.splitlines())), reasons.splitlines()


def reason(rows):
    """The number of the reason of the first of @p rows, whose other choices are the plainest."""
    return f"({rows[0]['taken']})"


def cell(rows):
    """A cell of rows that differ in OTHERS: yes, the choices that are not taken, or no."""
    if all(row["taken"] == "yes" for row in rows):
        return "yes"
    if not any(row["taken"] == "yes" for row in rows):
        return "– " + reason(rows)
    excluded, rest = [], rows
    # One choice, and then two of them together, with which nothing is taken.
    for size in (1, 2):
        for names in itertools.combinations(OTHERS, size):
            for values in itertools.product(*(sorted({row[n] for row in rest})
                                              for n in names)):
                def has(row, names=names, values=values):
                    return all(row[n] == v for n, v in zip(names, values))
                of_choice = [row for row in rest if has(row)]
                if of_choice and not any(row["taken"] == "yes" for row in of_choice):
                    excluded.append(" with ".join(WORDS[pair] for pair in zip(names, values))
                                    + " " + reason(of_choice))
                    rest = [row for row in rest if not has(row)]
    assert all(row["taken"] == "yes" for row in rest), rest
    return "not: " + ", ".join(excluded)


def tables(rows, reasons):
    """The tables in Markdown, and the list of reasons."""
    key = ("contact", "treatment", "scheme")
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in key), []).append(row)
    schemes = list(dict.fromkeys(row["scheme"] for row in rows))
    treatments = list(dict.fromkeys(row["treatment"] for row in rows))
    text = []
    for contact, title in CONTACTS.items():
        cells = {(treatment, scheme): cell(groups[contact, treatment, scheme])
                 for treatment in treatments for scheme in schemes}
        # Schemes with the same column share it, treatments with the same row, too.
        columns = {}
        for scheme in schemes:
            columns.setdefault(tuple(cells[t, scheme] for t in treatments), []).append(scheme)
        lines = {}
        for k, treatment in enumerate(treatments):
            lines.setdefault(tuple(column[k] for column in columns), []).append(treatment)
        text += [f"## {title}\n",
                 "| treatment | " + " | ".join(", ".join(names) for names in
                                               columns.values()) + " |",
                 "|---" * (1 + len(columns)) + "|"]
        text += ["| " + "; ".join(names) + " | " + " | ".join(line) + " |"
                 for line, names in lines.items()]
        text.append("")
    text.append("## Reasons\n")
    text += [f"{k}. {reason}" for k, reason in enumerate(reasons, 1)]
    return "\n".join(text) + "\n"


def with_tables(page, made):
    """The text of the page with these tables between the marks."""
    before, rest = page.split(BEGIN)
    return before + BEGIN + "\n" + made + "\n" + END + rest.split(END)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build-dir", type=pathlib.Path,
                        default=PAGE.parents[1] / "build" / "release")
    made = tables(*read(parser.parse_args().build_dir / "ricochet"))
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8"), made), encoding="utf-8")


if __name__ == "__main__":
    main()
