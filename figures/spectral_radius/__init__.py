# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), figures 3 and 4: spectral radii.

The program spectral_radius takes the amplification matrices from the same time integrators that the
benchmarks use, and the errors of a free oscillator.
"""
