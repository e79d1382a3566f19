# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recipe of Spack; doc/how_to/install.md has its commands."""

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Ricochet(CMakePackage):
    """Dynamic contact of elastic bodies, with an energy balance that closes."""

    license("LGPL-2.1-or-later")

    # Sources are a checkout that `spack develop` names; there is no archive to fetch.
    version("0.2.0")

    depends_on("cxx", type="build")
    depends_on("cmake@3.18:", type="build")
    depends_on("dealii@9.4:+mpi+trilinos+sundials+hdf5")
    depends_on("mpi")
    depends_on("hdf5+mpi")
    depends_on("suite-sparse")
    depends_on("eigen@3.4:3")
    depends_on("boost")
    depends_on("gmsh")
    # Commands to draw and to compare runs.
    depends_on("python@3.11:", type=("build", "run"))
    depends_on("py-numpy", type="run")
    depends_on("py-matplotlib", type="run")

    def cmake_args(self):
        return [self.define("RICOCHET_AVX2", "avx2" in self.spec.target)]
