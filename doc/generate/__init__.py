# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the pages of the site from programs, sources, parameter files, figures and runs.

    python3 doc/make_pages.py --programs build/release --to build/doc/source

writes a folder that Sphinx turns into HTML; scripts/docs.sh does both. Each module makes one
kind of page. Handwritten pages are beside this folder, and are copied.
"""

import pathlib
import sys

# The package `ricochet`, and the figures with their common parts, are of this checkout.
for _name in ("python", "figures"):
    _folder = str(pathlib.Path(__file__).resolve().parents[2] / _name)
    if _folder not in sys.path:
        sys.path.insert(0, _folder)
