# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 6: the disk is full, or files may not grow any more."""

from case import ACCEPTED, ANY, NOT_ACCEPTED, REFUSED
from programs import ALL, BARS, THROWN, small

LARGEST = 200000
FILES = ("energy.csv", "energy.h5", "log.txt", "parameters.prm", "checkpoint.bin",
         "solution", "obstacles", ".vtu", "spectral_radii.csv", "oscillator_order.csv")


def settings_for(case, program):
    settings = small(program)
    if program != "spectral_radius":
        settings["Output/Fields every"] = str(case.rng.choice([0, 0, 1, 4]))
        settings["Output/Checkpoint every"] = str(case.rng.choice([0, 1, 5]))
        settings["Output/Log every"] = str(case.rng.choice([0, 1]))
    return settings


def size(rng):
    """Anything to the largest, small ones more often."""
    return rng.choice([0, rng.randrange(2000), rng.randrange(20000),
                       rng.randrange(60000), rng.randrange(LARGEST)])


def undisturbed(case, program, settings):
    """Output changes nothing in the ledger."""
    settings = {name: value for name, value in settings.items()
                if not name.startswith("Output/")}
    settings["Output/Fields every"] = "0"
    return case.undisturbed(program, settings)


def check_that_a_file_is_named(case, result):
    names = FILES + (str(case.run_folder),)
    if result.code in (1, 2) and not any(name in result.err for name in names):
        case.finding("a full disk, and no file or folder is named",
                     result.err.strip()[:200])


def go_on(case, program, settings):
    """There is room again: go on to the ledger of an undisturbed run."""
    case.note("without the limit")
    if program == "spectral_radius":
        case.attempt(program, settings, ANY, options=["--overwrite"])
        return
    can_resume = (case.run_folder / "checkpoint.bin").exists()
    result = case.attempt(program, settings, ACCEPTED if can_resume else REFUSED,
                          options=["--resume"])
    if result.code == 0:
        case.expect_same_ledger(case.run_folder,
                                undisturbed(case, program, settings))


def limited_files(case, program, settings):
    words = case.command(program, settings)
    result = case.execute_limited(words, size(case.rng), case.rng.random() < .3)
    case.judge(result, program, ANY, case.run_folder)
    check_that_a_file_is_named(case, result)
    if result.code != 0:
        go_on(case, program, settings)


def small_disk(case, program, settings):
    """A file system of a few pages in place of the output folder."""
    case.mount(max(4096, size(case.rng)))
    try:
        result = case.attempt(program, settings)
        check_that_a_file_is_named(case, result)
        if result.code != 0:
            case.remount("size=20m")
            go_on(case, program, settings)
    finally:
        case.unmount()


def no_disk_at_all(case, program, settings):
    """Nothing could be begun, and that is what it says."""
    words = case.command(program, settings)
    result = case.execute_limited(words, 0, with_signal=False)
    case.judge(result, program, NOT_ACCEPTED)
    check_that_a_file_is_named(case, result)


def run(case):
    program = case.rng.choice(ALL + BARS + THROWN)
    settings = settings_for(case, program)
    chance = case.rng.random()
    if chance < .3 and case.context.can_mount:
        small_disk(case, program, settings)
    elif chance < .36:
        no_disk_at_all(case, program, settings)
    else:
        limited_files(case, program, settings)
