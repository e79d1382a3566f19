# SPDX-License-Identifier: LGPL-2.1-or-later
"""Papers A and B, section 6.1: the elastic ball.

All runs start just above the foundation. Where nothing else is said their mesh is the papers', of
7820 nodes, 128 of them on the circle.
"""
