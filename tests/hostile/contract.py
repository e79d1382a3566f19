# SPDX-License-Identifier: LGPL-2.1-or-later
"""Promises of every program for every run, whatever its input.

Each check returns a list of complaints, (sort, detail): the sort is the same for
the same kind of defect, so that findings can be grouped.
"""

import base64
import csv
import math
import re
import struct
import zlib

# Names of libraries and of the language's own machinery: none of them helps who
# runs a finished program.
FORBIDDEN = (
    "dealii", "Stacktrace", "An error occurred in line", "boost::", "std::",
    "terminate called", "violated", "what():", "Assertion", "map::at",
    "basic_string", "vector::", "bad_alloc", "Trilinos", "Teuchos", "HDF5-DIAG",
    "an error that should not happen", "Segmentation", "p4est", "stoi", "stod",
    "iostream")

LONGEST_REPORT = 24
LARGEST_RESIDUAL = 1e-6
HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
TEMPORARY = re.compile(r"\.(unfinished|new|tmp|temp|part|partial|old|bak)$|~$")


def check_texts(result):
    """No text of a library, with any exit code."""
    text = result.out + result.err
    found = [word for word in FORBIDDEN if word in text]
    return [("text of a library in the output", ", ".join(found))] if found else []


def check_exit(result, expected):
    """0, 1, 2 or 4, and in time; @p expected says which of them. A complete run with an open energy
    (4) is as good as 0 here: the run has reported it."""
    if result.timed_out:
        return [("hangs", f"no end within {result.seconds:.0f} s")]
    if result.code < 0 or result.code > 128:
        number = -result.code if result.code < 0 else result.code - 128
        return [("ends by a signal", f"signal {number}")]
    if result.code not in (0, 1, 2, 4):
        return [("exit code other than 0, 1, 2, 4", f"exit code {result.code}")]
    if (0 if result.code == 4 else result.code) not in expected:
        allowed = " or ".join(map(str, sorted(expected)))
        if result.code in (0, 4):
            return [("accepted nonsense",
                     f"exit code {result.code} in place of {allowed}")]
        return [("another exit code than expected",
                 f"exit code {result.code} in place of {allowed}: "
                 + first_sentence(result.err))]
    return []


def check_report(result, program, n_ranks=1):
    """Something went wrong: one report, short, with a sentence."""
    if result.code == 0 or result.timed_out:
        return []
    complaints = []
    lines = result.err.strip().splitlines()
    # mpirun adds a report of its own; only the program's is its business.
    if n_ranks == 1 and len(lines) > LONGEST_REPORT:
        complaints.append(("report of too many lines", f"{len(lines)} lines"))
    n_reports = sum(line.startswith(program + ": ") for line in lines)
    if n_reports > 1:
        complaints.append(("several reports", f"{n_reports} reports"))
    if not re.search(r"\w+\W+\w+\W+\w+.*[.?!)]", result.err):
        complaints.append(("no sentence on standard error", repr(result.err[:80])))
    return complaints


def first_sentence(text):
    lines = [line for line in text.strip().splitlines() if line.strip()]
    return " / ".join(lines[:2])[:300]


def read_settings(prm):
    """The values in a parameters.prm, by "Section/Name"."""
    path, values = [], {}
    for line in prm.read_text(errors="replace").splitlines():
        line = line.split("#")[0].strip()
        if line.startswith("subsection "):
            path.append(line.split(None, 1)[1])
        elif line == "end" and path:
            path.pop()
        elif line.startswith("set ") and "=" in line:
            name, value = line[4:].split("=", 1)
            values["/".join(path + [name.strip()])] = value.strip()
    return values


def check_ledger(csv_file, settings):
    """Every number finite, times rise to the end, the balance is closed."""
    try:
        with open(csv_file, newline="") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        return [("no energy.csv after success", str(error))]
    if len(rows) < 2:
        return [("energy.csv is empty after success", f"{len(rows)} rows")]
    names = [cell.split(" [")[0] for cell in rows[0]]
    times, energies, residuals = [], [], []
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            return [("row of energy.csv is not whole", f"row {number}")]
        for name, cell in zip(names, row):
            # Bodies may nowhere face each other.
            if cell == "" and (name in ("modified_energy", "total_energy",
                                        "promise_residual") or "_gap_" in name
                               or name.startswith("contact_work_")):
                continue
            try:
                value = float(cell)
            except ValueError:
                return [("energy.csv holds what is no number",
                         f"row {number}, {name}: {cell!r}")]
            if not math.isfinite(value):
                return [("energy.csv holds what is not finite",
                         f"row {number}, {name}: {cell}")]
        times.append(float(row[names.index("time")]))
        energies.append(float(row[names.index("energy")]))
        residuals.append(float(row[names.index("balance_residual")]))
    # Relative to the initial energy; where a displacement is imposed, to the largest
    # energy so far, which is next to nothing at the beginning. A body that is only moved, by
    # millimetres, has no energy except round-off of some 1e-13. Loads may bring more energy than
    # there was by any factor, and its round-off with it.
    largest = max(energies)
    for number, residual in enumerate(residuals, 1):
        # The column measures by the largest sum so far; bodies at rest begin with round-off.
        residual *= max(energies[:number]) / max(largest, 1e-6)
        if abs(residual) >= LARGEST_RESIDUAL:
            return [("success although the balance does not close",
                     f"row {number}: {residual}")]
    if any(b <= a for a, b in zip(times, times[1:])):
        return [("times in energy.csv do not rise", "")]
    final = float(settings.get("Time/Final time", "nan"))
    if not times[-1] >= final * (1 - 1e-8):
        return [("the run ended before its final time",
                 f"{times[-1]} of {final}")]
    return []


def check_fields(folder):
    """All files that solution.pvd and obstacles.pvd list are there and whole."""
    if not (folder / "solution.pvd").is_file():
        return [("no solution.pvd after success", "")]
    complaints = check_list_of_fields(folder, "solution.pvd")
    if (folder / "obstacles.pvd").exists():
        complaints += check_list_of_fields(folder, "obstacles.pvd")
        complaints += check_surfaces(folder)
    return complaints


def check_surfaces(folder):
    """The surfaces of obstacles are finite."""
    for file in sorted((folder / "solution").glob("obstacles-*.vtu")):
        if not all(map(math.isfinite, floats_of(file.read_text(errors="replace")))):
            return [("the surface of an obstacle is not finite", file.name)]
    return []


def floats_of(vtu):
    """All numbers of single precision in a file: text, or one compressed block each."""
    for form, text in re.findall(r'<DataArray type="Float32"[^>]*format="(\w+)">'
                                 r'([^<]*)<', vtu):
        if form == "ascii":
            yield from map(float, text.split())
        else:
            # Four integers come first, in a text of their own.
            data = zlib.decompress(base64.b64decode(text.strip()[24:]))
            yield from struct.unpack(f"<{len(data) // 4}f", data)


def check_list_of_fields(folder, list_name):
    pvd = folder / list_name
    text = pvd.read_text(errors="replace")
    names = re.findall(r'file="([^"]*)"', text)
    if not names or not text.rstrip().endswith("</VTKFile>"):
        return [(f"{list_name} is not whole after success", f"{len(names)} files")]
    for name in names:
        file = folder / name
        if not file.is_file() or file.stat().st_size == 0:
            return [(f"a file of {list_name} is missing or empty", name)]
        with open(file, "rb") as content:
            content.seek(max(0, file.stat().st_size - 40))
            if not content.read().rstrip().endswith(b"</VTKFile>"):
                return [(f"a file of {list_name} is cut short", name)]
    return []


def check_no_temporary_files(folder):
    left = [str(file.relative_to(folder)) for file in folder.rglob("*")
            if TEMPORARY.search(file.name)]
    return [("temporary files are left", ", ".join(left))] if left else []


def check_spectra(folder):
    """The two tables of spectral_radius are there and hold numbers."""
    for name in ("spectral_radii.csv", "oscillator_order.csv"):
        file = folder / name
        lines = file.read_text().splitlines() if file.is_file() else []
        if len(lines) < 2:
            return [("a table is missing or empty after success", name)]
        for line in lines[1:]:
            cells = line.split(",")
            if (len(cells) != len(lines[0].split(","))
                    or not all(is_finite_number(cell) for cell in cells)):
                return [("a table holds what is no finite number",
                         f"{name}: {line[:100]}")]
    return []


def is_finite_number(cell):
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False


def check_results(program, folder):
    """A run has ended with success: all that it leaves is whole."""
    if program == "spectral_radius":
        return check_spectra(folder) + check_no_temporary_files(folder)
    if not (folder / "parameters.prm").is_file():
        return [("no parameters.prm after success", "")]
    settings = read_settings(folder / "parameters.prm")
    resumed = folder / "parameters.resumed.prm"
    if resumed.is_file():
        settings = read_settings(resumed)
    complaints = check_ledger(folder / "energy.csv", settings)
    h5 = folder / "energy.h5"
    if not h5.is_file() or h5.read_bytes()[:8] != HDF5_SIGNATURE:
        complaints.append(("energy.h5 is no HDF5 file after success", ""))
    if settings.get("Output/Fields every", "0") != "0":
        complaints += check_fields(folder)
    return complaints + check_no_temporary_files(folder)
