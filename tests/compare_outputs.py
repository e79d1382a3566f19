#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compare the output of a regression with a stored one, strictly.

    compare_outputs.py [options of numdiff, which are not looked at] STORED NEW

Words and whole numbers are the same, except for the number of Newton iterations of a step: where
the residual comes near the tolerance, round-off decides whether another one follows, so that it may
differ by a quarter or by two, and whether its stage begins again from the last state. Other numbers agree to 1e-7 of the largest number of
their column or to one in their last digit, plus 1e-9 for round-off: residuals and drifts. A column
is the same place in lines with the same words. The first line, with versions, is not compared.
"""

import math
import re
import sys

RELATIVE, ROUND_OFF = 1e-7, 1e-9
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*(?:[eE][-+]?\d+)?|nan|inf)(?![\w.])")


# Part of the line of how steps were solved on which round-off decides.
BEGUN_AGAIN = re.compile(r", stage begun again from the last state \d+$")

# A step in the log: the last number is that of the iterations.
STEP = re.compile(r"\s*\d+/\d+ .* \d+  \S+$")


def read(name):
    """For each line its words, without numbers and blanks, its numbers, and whether it is a
    step."""
    with open(name) as file:
        lines = [BEGUN_AGAIN.sub("", line) for line in file.read().splitlines()[1:]]
    return [("".join(NUMBER.sub("#", line).split()), NUMBER.findall(line),
             bool(STEP.match(line))) for line in lines]


def last_digit(number):
    """The value of one in the last digit of a number as it is written."""
    digits, _, exponent = number.lower().partition("e")
    return 10. ** (int(exponent or 0) - len(digits.partition(".")[2]))


def differences(stored, new):
    if len(stored) != len(new):
        yield f"{len(stored)} lines are stored, and {len(new)} are new"
    largest = {}
    for words, numbers, _ in stored:
        for place, number in enumerate(numbers):
            column = words, place
            if math.isfinite(float(number)):
                largest[column] = max(largest.get(column, 0.), abs(float(number)))
    for line, ((words, numbers, is_step), (new_words, new_numbers, _)) in enumerate(
            zip(stored, new), start=2):
        if words != new_words or len(numbers) != len(new_numbers):
            yield f"line {line}: '{words}' is stored, and '{new_words}' is new"
            continue
        for place, (one, other) in enumerate(zip(numbers, new_numbers)):
            if one == other:
                continue
            bound = max(RELATIVE * largest.get((words, place), 0.),
                        1.01 * last_digit(one)) + ROUND_OFF
            if re.fullmatch(r"[-+]?\d+", one) and re.fullmatch(r"[-+]?\d+", other):
                is_iterations = is_step and place == len(numbers) - 1
                bound = max(2, int(one) // 4) if is_iterations else 0
            if not abs(float(one) - float(other)) <= bound:
                yield (f"line {line}, number {place + 1}: {one} is stored, and {other} is "
                       f"new, which may differ by {bound:.2g}")


def main():
    # By which deal.II's harness finds out whether the program runs.
    if sys.argv[1:] == ["-v"]:
        return 0
    found = list(differences(*map(read, sys.argv[-2:])))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
