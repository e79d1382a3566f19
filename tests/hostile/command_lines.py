# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 2: command lines that nobody should type."""

import contract
from case import ANY, NOT_ACCEPTED, REFUSED
from programs import ALL, FILES, RUNS, small, start_of_command

OPTIONS = ["--set", "--output-dir", "--resume", "--overwrite", "--validate",
           "--print-parameters", "--quiet", "--help", "--version"]

WRONG_ASSIGNMENTS = [
    "=1", "/Time/Time step=0.1", "Time//Time step=0.1", "Time", "Time/=1",
    "Time/Time step=", "=", "", "Time/Time step", "Time/Time step=0.1=2",
    "Time/Time step/=0.1", "Time.Time step=0.1", "/", "//", "/=", "Time=",
    "Time=1", "Time step=0.1", "Time/Time step:0.1", "Time/Time/Time step=0.1",
    "Time/Time step=0.1/2", "Time/Time step=nan", "Time/Time step=1e400",
    "Time/Timestep=0.1", "Tíme/Time step=0.1", "\udcff/\udcfe=\udcfd",
    "x" * 100000 + "=1", "Time/" * 10000 + "Time step=1",
    "Time/Time step=" + "9" * 100000, "Time/Time step=0.1\nend",
    "Contact/Treatment=", "Contact/Treatment=nitsche2", "Output/Timing=perhaps",
    "Time/Time step=%n%s", "_/_=_", "_zz=1", "Time/_=1"]

ODD_WORDS = [[""], ["-"], ["--"], ["-x"], ["--set=Time/Time step=0.1"],
             ["--output-dir=x"], ["\udcff"], ["x" * 5000], ["-h", "-h"], ["\n"],
             ["--no-resume"], ["--Help"], ["--output_dir", "x"], ["%s%n"]]


def wrong_assignment(case, program):
    words = ["--set", case.rng.choice(WRONG_ASSIGNMENTS)]
    return words, NOT_ACCEPTED


def misspelt_option(case, program):
    option = case.rng.choice(OPTIONS)
    k = case.rng.randrange(2, len(option))
    word = option[:k] + case.rng.choice(["", "q", option[k] * 2]) + option[k + 1:]
    return [word], ANY if word in OPTIONS else NOT_ACCEPTED


def missing_value(case, program):
    option = case.rng.choice(["--set", "--output-dir"])
    after = case.rng.choice([[], [""], ["--resume"], ["--validate"], ["--"]])
    return ["--validate", option] + after, NOT_ACCEPTED


def odd_words(case, program):
    words = case.rng.choice(ODD_WORDS)
    return words + ["--validate"], ANY


def repeated(case, program):
    option = case.rng.choice(["--validate", "--quiet", "--help", "--version",
                              "--print-parameters"])
    return [option] * case.rng.choice([2, 3, 1000]), ANY


def many_options(case, program):
    return case.rng.sample(OPTIONS, case.rng.randrange(2, 7)), ANY


def two_files(case, program):
    folder = case.context.root / "parameter_files" / program
    file = str(FILES.get(program, folder / "default.prm"))
    return [file, file, "--validate"], NOT_ACCEPTED


def no_file(case, program):
    name = case.rng.choice([str(case.folder), ".", "/", "missing.prm", "",
                            "/dev/null/x", "/proc/self/mem", "x" * 5000])
    return [name, "--validate"], NOT_ACCEPTED


FORMS = [wrong_assignment] * 5 + [misspelt_option] * 3 + [
    missing_value, odd_words, repeated, many_options, two_files, no_file]


def words_alone(case, program):
    """Words in any wrong form; nothing is computed."""
    words, expected = case.rng.choice(FORMS)(case, program)
    if not {"--validate", "--help", "--version"} & set(words):
        words = words + ["--validate"]
    start = [str(case.context.programs / program)]
    if case.rng.random() < .7:
        start = start_of_command(case, program)
    result = case.execute(start + words)
    case.judge(result, program, expected)


def bad_output_folder(case, program):
    """A folder that cannot be written to is refused before anything is done."""
    blocker = case.write("file", "")
    folder, cwd = case.rng.choice([
        (str(blocker), None), (str(blocker / "below"), None),
        (str(blocker / "a" / "b"), None), ("/proc/x", None),
        ("/proc/self/x", None), ("/sys/x", None), ("x" * 300, None),
        ("a/" * 3000 + "x", None), ("/dev/null", None), ("/dev/full", None),
        ("", None)])
    words = case.command(program, small(program), folder=folder)
    if folder == "":
        words[words.index("--output-dir") + 1] = ""
    result = case.execute(words, cwd)
    case.judge(result, program, REFUSED)


def resume_of_nothing(case, program):
    """There is no checkpoint in an empty folder."""
    if case.rng.random() < .5:
        case.run_folder.mkdir()
    case.attempt(program, small(program), REFUSED, options=["--resume"])


def full_console(case, program):
    """The requested text cannot be printed: that is no success."""
    option = case.rng.choice(["--print-parameters", "--help", "--version"])
    words = ["sh", "-c", 'exec "$0" "$@" >/dev/full',
             str(case.context.programs / program), option]
    result = case.execute(words)
    case.judge(result, program, NOT_ACCEPTED)
    if result.code != 0 and len(result.err.strip().splitlines()) > 6:
        case.finding("long report of a full console",
                     contract.first_sentence(result.err))


def run(case):
    program = case.rng.choice(ALL)
    chance = case.rng.random()
    if chance < .7:
        words_alone(case, program)
    elif chance < .84:
        bad_output_folder(case, program)
    elif chance < .92:
        resume_of_nothing(case, case.rng.choice(RUNS))
    else:
        full_console(case, program)
