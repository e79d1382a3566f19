#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sphere of paper C (4.3) with GetFEM: Nitsche, Crank-Nicolson, quadratic tetrahedra.

    getfem_sphere.py soft|hard MESH.msh FINAL_TIME OUTPUT.csv

theta = 1 and gamma_0 = 100 mu, on a mesh of Ricochet's (Gmsh 2.2, surface 1 in contact); one of
second order has curved cells. Started by compare.py; needs the Debian package python3-getfem.
"""

import sys

import getfem as gf
import numpy as np

from crank_nicolson import CrankNicolson, to_scipy

# Lame's lambda = mu (Pa), time step (s).
SPHERES = {"soft": (20.0, 0.25), "hard": (30000.0, 0.05)}
DENSITY, GRAVITY = 1.0, -0.1
CONTACT = 1
# The pressure is the traction towards the body, against the normal of the plane z = 0.
STRESS = "(lame*Trace({0})*Id(3)+lame*({0}+{0}'))"
PRESSURE = f"([0;0;1].({STRESS.format('Grad_u')}*Normal))"
PRESSURE_CHANGE = f"([0;0;1].({STRESS.format('Grad_Test_u')}*Normal))"
TRIAL = f"({PRESSURE}-gamma*(X(3)+u(3)))"
NITSCHE = (
    f"(pos_part({TRIAL})*({PRESSURE_CHANGE}-gamma*Test_u(3))-{PRESSURE}*{PRESSURE_CHANGE})/gamma"
)


def diameters(mesh, cells):
    """The largest distance of two vertices of each cell (m)."""
    result = []
    for cell in cells:
        vertices = mesh.pts_from_cvid(cell)[0]
        # The vertices of a cell of second order are the nodes farthest from each other.
        distances = np.linalg.norm(vertices[:, :, None] - vertices[:, None, :], axis=0)
        result.append(distances.max())
    return np.array(result)


def main():
    name, file, final_time, output = sys.argv[1:]
    lame, time_step = SPHERES[name]
    mesh = gf.Mesh("import", "gmsh", file)
    field = gf.MeshFem(mesh, 3)
    field.set_fem(gf.Fem("FEM_PK(3,2)"))
    rule = gf.MeshIm(mesh, gf.Integ("IM_TETRAHEDRON(5)"))
    constant = gf.MeshFem(mesh, 1)
    constant.set_fem(gf.Fem("FEM_PK(3,0)"))
    cells = mesh.cvid()
    gamma = np.zeros(constant.nbdof())
    of_cell = diameters(mesh, cells)
    for cell, size in zip(cells, of_cell):
        gamma[constant.basic_dof_from_cv(cell)] = 100 * lame / size

    def assemble(order, text, region, u):
        return gf.asm_generic(
            rule,
            order,
            text,
            region,
            "u",
            1,
            field,
            u,
            "gamma",
            0,
            constant,
            gamma,
            "lame",
            0,
            np.array([lame]),
        )

    def contact_force(u):
        return assemble(0, f"pos_part({TRIAL})", CONTACT, u)

    def contact(u, with_tangent):
        tangent = to_scipy(assemble(2, NITSCHE, CONTACT, u)) if with_tangent else None
        return assemble(1, NITSCHE, CONTACT, u), tangent, contact_force(u) > 0

    zero = np.zeros(field.nbdof())
    mass = DENSITY * to_scipy(assemble(2, "u.Test_u", -1, zero))
    stiffness = to_scipy(assemble(2, f"{STRESS.format('Grad_u')}:Grad_Test_u", -1, zero))
    load = DENSITY * GRAVITY * assemble(1, "Test_u(3)", -1, zero)
    ball = CrankNicolson(mass, stiffness, load, contact, time_step)
    ball.start(zero, zero.copy())
    nodes = field.basic_dof_nodes()
    lowest = 3 * (nodes[2, ::3].argmin()) + 2

    rows = []
    for n in range(round(float(final_time) / time_step) + 1):
        iterations = ball.step() if n > 0 else 0
        rows.append(
            [n * time_step, ball.u[lowest], ball.v[lowest], contact_force(ball.u), iterations]
        )
    columns = ("time", "lowest_displacement", "lowest_velocity", "contact_force")
    np.savetxt(
        output,
        rows,
        delimiter=",",
        header=",".join([*columns, "newton_iterations"]),
        comments="",
    )
    print(f"seconds {ball.seconds:.6g}")


if __name__ == "__main__":
    main()
