# SPDX-License-Identifier: LGPL-2.1-or-later
"""Papers A and B, section 6.2: the hyperelastic ring.

Figure A-11 has the papers' mesh of 128 x 13 nodes; where many runs are needed, the mesh has
64 x 5 nodes. R-1, of no paper, is the ring that feels itself.
"""
