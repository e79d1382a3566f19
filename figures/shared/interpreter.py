# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Python with the modules that the figures need."""

import importlib.util
import os
import sys

DEBIAN_PYTHON = "/usr/bin/python3"
PACKAGES = {
    "numpy": "python3-numpy",
    "matplotlib": "python3-matplotlib",
    "vtkmodules": "python3-vtk9",
}


def need(*modules):
    """Start again with Debian's Python if this one, the first in the PATH, lacks some modules."""
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if not missing:
        return
    if os.path.exists(DEBIAN_PYTHON) and not os.environ.get("RICOCHET_FIGURES_PYTHON"):
        os.environ["RICOCHET_FIGURES_PYTHON"] = DEBIAN_PYTHON
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, *sys.argv])
    packages = " ".join(PACKAGES[name] for name in missing)
    sys.exit(f"{', '.join(missing)} is missing: apt-get install {packages}")
