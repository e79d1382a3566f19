# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), section 4.3: the sphere in three dimensions.

The paper prints no number of its figures 16 and 17. Runs of GetFEM, its reference tool, with the
same data stand beside ours in benchmarks/peers.
"""
