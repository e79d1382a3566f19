# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of figures 16 and 17."""

from shared.figure import check, info
from shared.rows import checks_of_runs, statement

from .common import CURVED, HARD, SCHEMES, SOFT
from .measures import change_of_energy, hertz_force, peak, touches, variation


def checks_series(sphere):
    rows = []
    # A step; the facets of the mesh and the quadrature points on them leave 0.1 s
    # open when a hard body touches.
    slack = (0.25, 0.375, 0.5) if sphere is SOFT else (0.16, 0.2, 0.5)
    for scheme in SCHEMES:
        times = touches(sphere.runs[scheme.key].read())
        reference = sphere.reference["touches"]
        rows.append(
            check(
                f"{scheme.label}: touches, lifts off, touches again (s)",
                ", ".join(f"{t:g}" for t in times),
                all(abs(a - b) <= s + 1e-9 for a, b, s in zip(times, reference, slack)),
                "within " + ", ".join(f"{s:g}" for s in slack) + " s of the reference run",
                paper=", ".join(f"{t:g}" for t in reference),
            )
        )
    for scheme in SCHEMES:
        force, time = peak(sphere.runs[scheme.key].read(), sphere.first_bounce)
        if sphere is SOFT:
            rows.append(
                check(
                    f"{scheme.label}: largest force of the first bounce (N), at (s)",
                    f"{force:.4g}, {time:g}",
                    abs(force / sphere.reference["force"] - 1) < 0.03,
                    "within 3 %",
                    paper=f"{sphere.reference['force']:.4g}",
                )
            )
        else:
            exact = hertz_force(30000.0)
            # The reference has a run of this scheme alone.
            if scheme.key == "nitsche_cn":
                rows.append(
                    check(
                        f"{scheme.label}, straight cells: largest force (N)",
                        f"{force:.4g}",
                        abs(force / sphere.reference["straight_force"] - 1) < 0.03,
                        "within 3 % of the reference on the same mesh",
                        paper=f"{sphere.reference['straight_force']:.4g}",
                    )
                )
            rows.append(
                check(
                    f"{scheme.label}: largest force of the first bounce (N), at (s)",
                    f"{force:.4g}, {time:g}",
                    abs(force / exact - 1) < 0.08,
                    "within 8 % of Hertz: a few facets carry it",
                    exact=f"{exact:.4g}",
                )
            )
    for scheme in SCHEMES:
        total, gain = change_of_energy(sphere.runs[scheme.key].read())
        name = f"{scheme.label}: conserved energy, change and largest gain in a step"
        ours = f"{total:.1e}, {gain:.1e}"
        if scheme.key == "hybrid":
            rows.append(check(name, ours, gain < 1e-11, "no gain beyond Newton's tolerance"))
        elif scheme.key.endswith("_cn"):
            rows.append(info(name, ours, remark="what it gains and loses at contact changes"))
        else:
            rows.append(
                check(name, ours, -0.02 < total < 0, "loses, and at most 2 % of the energy")
            )
    if sphere is HARD:
        paper = sphere.reference
        table = CURVED.read()
        force, time = peak(table, sphere.first_bounce)
        times = touches(table)
        rows.append(
            check(
                "curved cells: largest force of the first bounce (N), at (s)",
                f"{force:.4g}, {time:g}",
                abs(force / paper["force"] - 1) < 0.02 and abs(time - paper["force_time"]) < 0.051,
                "within 2 % of the reference, and a step of its time",
                paper=f"{paper['force']:.4g}, {paper['force_time']:g}",
            )
        )
        rows.append(
            check(
                "curved cells: touches, lifts off, touches again (s)",
                ", ".join(f"{t:g}" for t in times),
                all(abs(a - b) < 0.101 for a, b in zip(times, paper["touches"])),
                "within 0.1 s of the reference run",
                paper=", ".join(f"{t:g}" for t in paper["touches"]),
            )
        )
    values = {key: variation(run.read()) for key, run in sphere.runs.items()}
    for method in ("nitsche", "alm"):
        rows.append(
            statement(
                f"{method}: variation of the velocity, TR-BDF2 and HHT (m/s)",
                f"{values[f'{method}_trbdf2']:.3g}, {values[f'{method}_hht']:.3g}",
                values[f"{method}_trbdf2"] < values[f"{method}_hht"],
                "TR-BDF2 is smoother",
                "TR-BDF2 smoother",
                "not here",
            )
        )
    rows.append(
        check(
            "variation of the velocity, hybrid over TR-BDF2",
            f"{values['hybrid'] / values['nitsche_trbdf2']:.3g}",
            values["hybrid"] > 2 * values["nitsche_trbdf2"],
            "more than 2",
            paper="strong oscillations",
        )
    )
    return rows + checks_of_runs(list(sphere.runs.values()) + ([CURVED] if sphere is HARD else []))
