# SPDX-License-Identifier: LGPL-2.1-or-later
"""Papers A and B, section 6.2: the hyperelastic ring.

The mesh is the papers', of 128 x 13 nodes; the scan of table A-T3 has 64 x 5 nodes. R-1, of no
paper, is the ring with self-contact.
"""
