#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD and 1D-SS of paper C with GetFEM: Nitsche, Crank-Nicolson, consistent mass.

    getfem_bars.py sd OUTPUT.csv
    getfem_bars.py ss OUTPUT.csv

h = dt = 0.05, gamma_0 = 5, theta = 1, as in parameter_files/bar_sd and bar_ss. Started by
compare.py; needs the Debian package python3-getfem.
"""

import sys

import getfem as gf
import numpy as np

from crank_nicolson import CrankNicolson, to_scipy

H, GAMMA_0, FINAL_TIME = 0.05, 5.0, 12.0
LEFT, RIGHT = 1, 2
# The pressure -sigma_n of a bar of unit modulus, and the gap: the obstacle of the left end is
# at 0, that of the right end at 3/2. Normals point out of the bar.
GAP = {LEFT: "(X(1)+u)", RIGHT: "(1.5-X(1)-u)"}
GAP_CHANGE = {LEFT: "Test_u", RIGHT: "(-Test_u)"}
PRESSURE, PRESSURE_CHANGE = "(-Grad_u)", "(-Grad_Test_u)"


def main():
    name, output = sys.argv[1:]
    mesh = gf.Mesh("cartesian", np.linspace(0, 1, round(1 / H) + 1))
    for region, x in ((LEFT, 0.0), (RIGHT, 1.0)):
        outer = mesh.outer_faces()
        chosen = [
            k
            for k in range(outer.shape[1])
            if np.abs(mesh.pts_from_cvid(outer[0, k])[0] - x).min() < 1e-9
            and np.abs(mesh.normal_of_face(*outer[:, k])[0] - (2 * x - 1)) < 1e-9
        ]
        mesh.set_region(region, outer[:, chosen])
    field = gf.MeshFem(mesh, 1)
    field.set_fem(gf.Fem("FEM_PK(1,1)"))
    rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS1D(3)"))

    def assemble(order, text, region, u):
        return gf.asm_generic(
            rule, order, text, region, "u", 1, field, u, "gamma", 0, np.array([GAMMA_0 / H])
        )

    ends = (LEFT,) if name == "sd" else (LEFT, RIGHT)

    def contact(u, with_tangent):
        force, tangent, is_active = np.zeros_like(u), None, False
        for end in ends:
            q = f"({PRESSURE}-gamma*{GAP[end]})"
            text = (
                f"(pos_part({q})*({PRESSURE_CHANGE}-gamma*{GAP_CHANGE[end]})"
                f"-{PRESSURE}*{PRESSURE_CHANGE})/gamma"
            )
            force += assemble(1, text, end, u)
            is_active |= assemble(0, f"pos_part({q})", end, u) > 0
            if with_tangent:
                part = to_scipy(assemble(2, text, end, u))
                tangent = part if tangent is None else tangent + part
        return force, tangent, is_active

    zero = np.zeros(field.nbdof())
    mass = to_scipy(assemble(2, "u.Test_u", -1, zero))
    stiffness = to_scipy(assemble(2, "Grad_u.Grad_Test_u", -1, zero))
    x = field.basic_dof_nodes()[0]
    order = np.argsort(x)
    held = [order[-1]] if name == "sd" else []
    bar = CrankNicolson(mass, stiffness, zero, contact, H, held)
    if name == "sd":
        bar.start(0.5 * (1 - x), zero.copy())
    else:
        bar.start(1 - 0.5 * x, np.full_like(x, -0.5))

    columns = ["time", "displacement_left", "velocity_left"]
    columns += ["displacement_right", "velocity_right"] * (name == "ss")
    rows = []
    for n in range(round(FINAL_TIME / H) + 1):
        iterations = bar.step() if n > 0 else 0
        row = [n * H, bar.u[order[0]], bar.v[order[0]]]
        if name == "ss":
            row += [bar.u[order[-1]], bar.v[order[-1]]]
        rows.append([*row, iterations])
    np.savetxt(
        output, rows, delimiter=",", header=",".join([*columns, "newton_iterations"]), comments=""
    )
    print(f"seconds {bar.seconds:.6g}")


if __name__ == "__main__":
    main()
