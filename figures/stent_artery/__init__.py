# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper B, section 7: a stent in an artery.

Units are mm, N, MPa, s: energies are in mJ, per mm of depth.
"""
