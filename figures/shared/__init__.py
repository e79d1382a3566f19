# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the figures of several benchmarks share. It finds the package ricochet of this checkout."""

import pathlib
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(CHECKOUT / "python"))
