# SPDX-License-Identifier: LGPL-2.1-or-later
"""The obstacle course: bodies on an incline, in a bowl, on a plate and in a drum.

No paper has these; they are compared with formulas by hand, conservation, and work that is computed
twice.
"""
