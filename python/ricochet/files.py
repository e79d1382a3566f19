# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files that may be a stranger's: read to a bound, and regular ones only."""

from __future__ import annotations

import pathlib
import stat

#: The largest file that is read as a text, except for tables (bytes).
LARGEST = 1 << 26


def read_bytes(path: pathlib.Path, largest: int | None = LARGEST) -> bytes:
    """The contents of a file.

    Raises:
        OSError: it cannot be read; a pipe or a device, which may never end, is not.
        ValueError: it is larger than `largest`, or than the memory.
    """
    status = path.stat()
    if not stat.S_ISREG(status.st_mode):
        raise OSError("it is no regular file")
    if largest is not None and status.st_size > largest:
        raise ValueError(f"it is larger than {largest} bytes")
    try:
        return path.read_bytes()
    except (MemoryError, OverflowError):
        raise ValueError("it is larger than the memory") from None


def read_text(path: pathlib.Path, largest: int | None = LARGEST) -> str:
    """The contents of a text file, with ends of lines as they are.

    Raises:
        OSError, ValueError: as of `read_bytes`, or it is no text in UTF-8.
    """
    return read_bytes(path, largest).decode("utf-8")
