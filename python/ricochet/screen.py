# SPDX-License-Identifier: LGPL-2.1-or-later
"""A screen for VTK."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence

from .errors import RicochetError


def run_with_screen(command: Sequence[str], environment: Mapping[str, str] | None = None) -> None:
    """Run a command that draws by VTK: Debian's needs an X server, and there is a virtual one.

    `environment` is added to that of this process.

    Raises:
        RicochetError: there is no screen, or the command fails; the message has its last line.
    """
    if not os.environ.get("DISPLAY"):
        if not shutil.which("xvfb-run"):
            raise RicochetError(
                "VTK needs a screen to draw on: install the packages xvfb and xauth, which have a "
                "virtual one."
            )
        command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1920x24", *command]
    # Not a pipe: a remaining server process would keep it open.
    with tempfile.TemporaryFile("w+", errors="replace") as log:
        result = subprocess.run(
            command,
            env={**os.environ, **(environment or {})},
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            check=False,
        )
        if result.returncode != 0:
            log.seek(0)
            last = (log.read().strip().splitlines() or ["it said nothing"])[-1]
            raise RicochetError(f"VTK cannot draw: {last.rstrip('.')}.")
