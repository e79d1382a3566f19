# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block that slides on a strip, on the level and on a slope.

No paper has it; it is compared with a rigid block, by hand.
"""
