# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors, each with one sentence for the user."""

from __future__ import annotations

import re


class RicochetError(Exception):
    """Anything that this package refuses or cannot do; the message is a sentence."""


class NotARun(RicochetError):
    """A folder, or a file in it, is missing or is not that of a run."""


class BadParameterFile(RicochetError):
    """A parameter file is missing or cannot be read."""


class ProgramError(RicochetError):
    """A program ended with another exit code than 0."""

    def __init__(self, program: str, exit_code: int, text: str) -> None:
        self.program = program
        self.exit_code = exit_code
        #: All that the program said.
        self.text = text
        #: The first sentence of it, in one line.
        self.sentence = first_sentence(text)
        super().__init__(f"{program}: {self.sentence}")


class Refused(ProgramError):
    """The program refused its input (exit code 1); nothing was computed."""


class Failed(ProgramError):
    """The computation failed, or the disk did (any other exit code)."""


class OpenRun(UserWarning):
    """A run is complete, but its balance or a promise of its contact is open (exit code 4)."""


def first_sentence(text: str) -> str:
    """The first sentence of what a program says, without the line that names it.

    A refusal is a line `PROGRAM: the input is not valid.`, and after it what is wrong.
    """
    lines = [line.strip() for line in text.splitlines()]
    for number, line in enumerate(lines):
        ends = "the input is not valid|the computation stopped|stopped by a signal"
        if re.search(rf": ({ends})\.$", line):
            lines = lines[number + 1 :]
            break
    words = " ".join(line for line in lines if line)
    # A sentence ends where a capital letter follows, so that "step.prm line 3" is none.
    match = re.match(r"(.+?[.!?])(?=\s+[A-Z'\"]|\s*$)", words)
    return match.group(1) if match else words or "It said nothing."
