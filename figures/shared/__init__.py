# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of several benchmarks. The package ricochet of this checkout is found
here."""

import pathlib
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(CHECKOUT / "python"))
