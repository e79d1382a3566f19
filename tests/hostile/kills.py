# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 8: runs that are killed, resumed, killed again, until they end."""

import os
import signal
import time

import contract
from case import ACCEPTED, HANG
from programs import BARS, THROWN, small, steps

NUMBERS_OF_KILLS = [1, 1, 1, 2, 2, 3, 5]
PATIENCE = 20.

# Methods of different kinds, and longer runs than elsewhere: a kill should come
# while something is computed.
STEPS = {"bar_sd": 240, "bar_ss": 240, "elastic_ball": 60, "hyperelastic_ring": 40,
         "obstacle_course": 40, "colliding_disks": 50, "stent_artery": 24,
         "sliding_block": 80, "colliding_spheres": 60, "ricochet": 120}
VARIANTS = {
    "bar_sd": [{}, {"Contact/Treatment": "Signorini active set",
                    "Time/Scheme": "HHT"}],
    "bar_ss": [{"Time/Scheme": "TR-BDF2"},
               {"Contact/Treatment": "proximal augmented Lagrangian"}],
    "elastic_ball": [{}, {"Contact/Treatment": "persistent contact"}],
    "hyperelastic_ring": [{}, {"Contact/Treatment": "Signorini active set",
                               "Contact/Friction coefficient": "0.2"}],
    "obstacle_course": [{}, {"Obstacle/Translation": "0; 0.5*t",
                             "Contact/Friction coefficient": "0.2"}],
    "colliding_disks": [{}, {"Contact/Treatment": "improved normal compliance",
                             "Contact/Friction coefficient": "0.2"}],
    "colliding_spheres": [{}, {"Contact/Treatment": "improved normal compliance",
                               "Contact/Friction coefficient": "0.2"}],
    "ricochet": [{}, {"Contact foot/Treatment": "persistent contact",
                      "Obstacle floor/Translation": "0; 0.01*sin(300*t)"}],
    "stent_artery": [{}, {"Contact/Friction coefficient": "0.2"}],
    "sliding_block": [{}, {"Contact/Treatment": "Signorini active set"}],
}


def settings_for(rng, program):
    settings = small(program)
    settings.update(steps(program, STEPS[program]))
    settings.update(rng.choice(VARIANTS[program]))
    return settings


def is_running(pid):
    """Processes that have ended may wait for init to reap them."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def killed_geometry(case):
    """Gmsh is busy with a script for ever: nothing of it outlives the run."""
    case.write("mesh.geo", "For i In {1:1e9}\nEndFor\n")
    prm = case.write("given.prm", "set Program = ricochet\nset Dimension = 2\n"
                     "subsection Body ball\n  set File = mesh.geo\nend\n")
    temporary = case.folder / "temporary"
    temporary.mkdir()
    process, _, _ = started = case.start(case.command("ricochet", prm=prm),
                                         environment={"TMPDIR": str(temporary)})
    end = time.monotonic() + HANG
    while not ranks_of(process.pid) and process.poll() is None \
            and time.monotonic() < end:
        time.sleep(.01)
    children = ranks_of(process.pid)
    if not children:
        case.finding("no process of Gmsh", f"exit code {process.poll()}")
    time.sleep(case.rng.random())
    number = case.rng.choice([signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
    case.note(f"signal {number} to it")
    os.kill(process.pid, number)
    process.wait(PATIENCE)
    time.sleep(.5)
    if any(map(is_running, children)):
        case.finding("a child process outlives the run", f"signal {number}")
    left = [file.name for file in temporary.glob("*ricochet*")]
    if left:
        case.finding("temporary files are left by a killed run", ", ".join(left))
    case.finish(started)


def signature(folder):
    """Changes as soon as the run writes anything."""
    marks = []
    for name in ("energy.csv", "log.txt", "checkpoint.bin", "solution.pvd"):
        try:
            status = os.stat(folder / name)
            marks.append((status.st_mtime_ns, status.st_size))
        except OSError:
            marks.append(None)
    return marks


def wait_for_the_moment(case, process, delay, from_start):
    """Sleep from the start, or from when the run first writes something."""
    before = signature(case.run_folder)
    end = time.monotonic() + HANG
    while not from_start and process.poll() is None \
            and signature(case.run_folder) == before and time.monotonic() < end:
        time.sleep(.002)
    end = time.monotonic() + delay
    while process.poll() is None and time.monotonic() < end:
        time.sleep(min(.005, max(0., end - time.monotonic())))


def ranks_of(mpirun):
    """The processes that mpirun started."""
    children = []
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", encoding="utf-8",
                          errors="replace") as file:
                    parent = int(file.read().rsplit(")", 1)[1].split()[1])
            except (OSError, ValueError, IndexError):
                continue
            if parent == mpirun:
                children.append(int(entry))
    return children


def strike(case, process, n_ranks, number):
    """Kill the run, or one of its ranks. Returns whether it was still there."""
    if process.poll() is not None:
        return False
    victims = ranks_of(process.pid) if n_ranks > 1 else [process.pid]
    if not victims:
        return False
    try:
        os.kill(case.rng.choice(victims), number)
    except ProcessLookupError:
        return False
    return True


def check_polite_end(case, result, number):
    """After a signal that asks for an end: a complete table and a checkpoint, or none of them,
    if the run had not begun. Returns whether the run was complete all the same."""
    if result.code == 0:
        return True
    if result.timed_out:
        case.finding("no end after a signal", f"signal {number}")
    elif result.code not in (128 + number, -number):
        case.finding("another exit code than that of the signal", f"{result.code}")
    elif result.code == 128 + number and "stopped by a signal" in result.err:
        for name in ("checkpoint.bin", "energy.csv", "energy.h5"):
            if not (case.run_folder / name).exists():
                case.finding("a signal leaves no " + name)
    return False


def killed_run(case, program, words, n_ranks, duration):
    """Start, strike, and see what is left. Returns the result, or None if it was
    killed."""
    from_start = case.rng.random() < .2
    delay = case.rng.random() * (1. if from_start else duration)
    began = time.monotonic()
    started = case.start(words)
    process = started[0]
    wait_for_the_moment(case, process, delay, from_start)
    number = case.rng.choice([signal.SIGKILL] * 4 + [signal.SIGINT, signal.SIGTERM])
    struck = strike(case, process, n_ranks, number)
    when = "after its start" if from_start else "after it first wrote something"
    case.note(f"{number.name} to {'a rank' if n_ranks > 1 else 'it'} {delay:.4f} s {when}"
              if struck else "ended by itself")
    killed_at = time.monotonic()
    result = case.finish(started, PATIENCE if struck else HANG, began)
    if not struck:
        return result
    if number != signal.SIGKILL and n_ranks == 1:
        return result if check_polite_end(case, result, number) else None
    if n_ranks > 1:
        if result.timed_out:
            case.finding("mpirun does not end after a rank was killed",
                         f"{time.monotonic() - killed_at:.0f} s")
        elif result.code == 0 and not contract.check_results(program,
                                                             case.run_folder):
            # The rank was struck when its work was done.
            return result
        elif result.code == 0:
            case.finding("success although a rank was killed")
    return None


def run(case):
    rng = case.rng
    program = rng.choice(BARS + THROWN)
    n_ranks = rng.choice([2, 3]) if rng.random() < 1 / 6 else 1
    if program == "ricochet" and rng.random() < .15:
        killed_geometry(case)
        return
    settings = settings_for(rng, program)
    if program == "colliding_spheres" and n_ranks > 1:
        # MUMPS, in parallel, sums up in the order in which messages come.
        settings["Linear solver/Factorisation"] = "KLU"
    reference = case.undisturbed(program, dict(settings,
                                               **{"Output/Fields every": "0"}),
                                 n_ranks)
    if reference is None:
        return
    settings["Output/Checkpoint every"] = str(rng.randrange(1, 8))
    fields_every = rng.choice([0, 0, 1, 7])
    settings["Output/Fields every"] = str(fields_every)
    duration = .5 if fields_every != 1 else 1.
    options, n_kills = [], rng.choice(NUMBERS_OF_KILLS)
    for attempt in range(2 * max(NUMBERS_OF_KILLS)):
        words = case.command(program, settings, n_ranks=n_ranks, options=options)
        if attempt < n_kills:
            result = killed_run(case, program, words, n_ranks, duration)
        else:
            result = case.execute(words, n_ranks=n_ranks)
        if result is None:
            options = ["--resume"]
        elif result.code == 1 and options and "does not exist" in result.err:
            # Killed before the first checkpoint: there is no state to continue from.
            if (case.run_folder / "checkpoint.bin").exists():
                case.judge(result, program, ACCEPTED, n_ranks=n_ranks)
                return
            options = []
        else:
            break
    else:
        case.finding("a killed run does not come to its end", f"{attempt} attempts")
        return
    case.judge(result, program, ACCEPTED, case.run_folder, n_ranks)
    if result.code == 0:
        case.expect_same_ledger(case.run_folder, reference)
        check_number_of_fields(case, fields_every, program)


def check_number_of_fields(case, fields_every, program):
    """No file of a field is lost in between."""
    if fields_every == 0:
        return
    expected = STEPS[program] // fields_every + 1
    for name in ("solution.pvd", "obstacles.pvd"):
        file = case.run_folder / name
        if name == "obstacles.pvd" and not file.exists():
            continue
        found = file.read_text().count("<DataSet")
        if found < expected:
            case.finding(f"{name} has lost fields", f"{found} of {expected}")
