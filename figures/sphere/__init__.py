# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), section 4.3: the sphere in three dimensions.

The reference times and forces are those of a run of the paper's reference tool (GetFEM) with the
same steps on the mesh with curved cells; the force of the hard sphere on straight ones, which
figure 17 shows besides, is one of its runs on those.
"""
