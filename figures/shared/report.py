# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of the checks, and the page of the figures."""

import csv
import html

from .figure import NO

COLUMNS = ("figure", "quantity", "paper", "exact", "ours", "ok?", "criterion")


def _row(check):
    return (
        check.figure,
        check.quantity,
        check.paper,
        check.exact,
        check.ours,
        check.status,
        check.criterion,
    )


def print_table(checks):
    rows = [COLUMNS] + [_row(check) for check in checks]
    widths = [max(len(row[i]) for row in rows) for i in range(len(COLUMNS))]
    for row in rows:
        print(" | ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


def write_csv(checks, path):
    """Write the checks; those of figures that were not made this time remain."""
    made = {check.figure for check in checks}
    rows = []
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            old = list(csv.reader(file))
        if old and tuple(old[0]) == COLUMNS:
            rows = [row for row in old[1:] if row and row[0] not in made]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)
        writer.writerows(_row(check) for check in checks)


def write_table(table, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([table.header, *table.rows])


STYLE = """
body { max-width: 68em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 sans-serif; color: #222 }
h2 { margin-top: 2.5em; border-top: 1px solid #ccc; padding-top: 1em }
img { max-width: 100%; height: auto }
div.table { overflow-x: auto }
table { border-collapse: collapse; font-size: 85% }
td, th { padding: .2em .7em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top }
table.numbers { font-size: 100% } table.numbers td, table.numbers th { padding: .3em .8em }
table.numbers td { white-space: nowrap }
td.yes { color: #060 } td.NO { background: #c00; color: #fff } td.differs { background: #fe9 }
"""


def _html_table(table):
    """The lines of a table of a figure."""
    text = html.escape
    return [
        '<div class="table"><table class="numbers"><tr>',
        *(f"<th>{text(cell)}</th>" for cell in table.header),
        "</tr>",
        *(
            "<tr>" + "".join(f"<td>{text(cell)}</td>" for cell in row) + "</tr>"
            for row in table.rows
        ),
        "</table></div>",
    ]


def write_html(figures, checks, path):
    """One page with every figure, its caption and its numbers."""
    text = html.escape
    failed = sum(check.status == NO for check in checks)
    lines = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>Ricochet: figures</title><style>{STYLE}</style></head><body>",
        "<h1>Figures of the papers, computed by Ricochet</h1>",
        f"<p>{len(figures)} figures, {len(checks)} numbers, {failed} of them off. A row marked "
        "<em>differs</em> is what we know to be different from the paper, with the reason. The table is also in "
        '<a href="checks.csv">checks.csv</a>.</p>',
        "<ul>",
        *(f'<li><a href="#{f.name}">{text(f.name)}</a> {text(f.title)}</li>' for f in figures),
        "</ul>",
    ]
    for figure in figures:
        lines += [
            f'<h2 id="{figure.name}">{text(figure.name)}: {text(figure.title)}</h2>',
            *([f'<img src="{figure.image}" alt="{text(figure.title)}">'] if figure.image else []),
            *(_html_table(figure.table()) if figure.table else []),
            *(
                [f'<img src="{figure.animation}" alt="{text(figure.title)}, moving">']
                if figure.animation
                else []
            ),
            f"<p>{text(figure.caption)}</p>",
        ]
        rows = [check for check in checks if check.figure == figure.name]
        if rows:
            lines.append('<div class="table"><table><tr>')
            lines += [f"<th>{text(column)}</th>" for column in COLUMNS[1:]]
            lines.append("</tr>")
            for check in rows:
                cells = "".join(
                    f'<td class="{check.status}">{text(cell)}</td>'
                    if cell is check.status
                    else f"<td>{text(cell)}</td>"
                    for cell in _row(check)[1:]
                )
                lines.append(f"<tr>{cells}</tr>")
            lines.append("</table></div>")
    lines.append("</body></html>")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
