# SPDX-License-Identifier: LGPL-2.1-or-later
"""Crank-Nicolson and Newton's method for what GetFEM has assembled.

Each step solves M a + K u + c(u) = f at its end, with the trapezoidal rule for displacement and
velocity; c is Nitsche's contact term. The equations are those of paper C (Huang, Pignet, Drouet and
Chouly), (24) with alpha = 0.
"""

import time as clock

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

TOLERANCE = 1e-12  # of the largest force


def to_scipy(matrix):
    """A sparse matrix of GetFEM."""
    pointers, indices = matrix.csc_ind()
    return scipy.sparse.csc_matrix((matrix.csc_val(), indices, pointers), matrix.size())


class CrankNicolson:
    """A body with mass, stiffness and load, some unknowns of which may be held at zero.

    `contact(u, with_tangent)` returns the contact term, its tangent or None, and whether some
    point is active; while none is, the tangent is the same, and its factorisation is reused.
    """

    def __init__(self, mass, stiffness, load, contact, time_step, held=()):
        self.mass, self.stiffness, self.load = mass, stiffness, load
        self.contact, self.time_step = contact, time_step
        self.free = np.setdiff1d(np.arange(mass.shape[0]), held)
        self.magnitude = abs(stiffness) + 4.0 / time_step**2 * abs(mass)
        self.kept = None
        self.n_iterations, self.seconds = 0, 0.0

    def _part(self, matrix):
        return matrix[self.free][:, self.free].tocsc()

    def start(self, displacement, velocity):
        self.u, self.v = displacement, velocity
        force = self.load - self.stiffness @ self.u - self.contact(self.u, False)[0]
        self.a = np.zeros_like(self.u)
        self.a[self.free] = scipy.sparse.linalg.spsolve(self._part(self.mass), force[self.free])

    def _solve(self, tangent, residual, is_active):
        if is_active or self.kept is None:
            inertia = 4.0 / self.time_step**2
            matrix = self._part(inertia * self.mass + self.stiffness + tangent)
            factors = scipy.sparse.linalg.splu(matrix)
            if not is_active:
                self.kept = factors
        else:
            factors = self.kept
        return factors.solve(residual)

    def step(self):
        """One step; returns its Newton iterations."""
        began = clock.monotonic()
        dt = self.time_step
        origin = self.u + dt * self.v + 0.25 * dt**2 * self.a
        u = self.u + dt * self.v + 0.5 * dt**2 * self.a
        n = 0
        while True:
            inertia = self.mass @ (4.0 / dt**2 * (u - origin))
            elastic = self.stiffness @ u
            force, tangent, is_active = self.contact(u, True)
            residual = (self.load - inertia - elastic - force)[self.free]
            size = max(np.abs(part).max() for part in (inertia, elastic, self.load))
            # A body that moves has small forces of large displacements.
            round_off = 1e-15 * (self.magnitude @ np.abs(u)).max()
            if n > 0 and np.abs(residual).max() <= max(TOLERANCE * size, round_off):
                break
            u = u.copy()
            u[self.free] += self._solve(tangent, residual, is_active)
            n += 1
            if n > 30:
                raise RuntimeError("Newton's method does not converge.")
        a = 4.0 / dt**2 * (u - origin)
        self.v = self.v + 0.5 * dt * (self.a + a)
        self.u, self.a = u, a
        self.n_iterations += n
        self.seconds += clock.monotonic() - began
        return n
