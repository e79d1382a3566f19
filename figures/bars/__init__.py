# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), figures 2 and 5 to 15: bars.

1D-SD (section 4.1) is a bar held at its right end that hits an obstacle with its left end;
1D-SS (section 4.2) flies to and fro between two obstacles. Figures of curves have the consistent
("standard") mass on the left and the redistributed one on the right.
"""
