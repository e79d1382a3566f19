# SPDX-License-Identifier: LGPL-2.1-or-later
# Sourced by demo.sh, test.sh and others, and by the recipes for containers: packages, configure,
# build.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Debian packages that Ricochet needs. OpenBLAS replaces the reference BLAS, which
# is five times slower in factorisations.
packages="cmake ninja-build g++ ccache libdeal.ii-dev libeigen3-dev libsuitesparse-dev
  libgmsh-dev libboost-dev
  libhdf5-openmpi-dev libsundials-dev libopenblas0-pthread openmpi-bin
  perl python3 python3-matplotlib python3-numpy python3-h5py
  python3-pandas python3-vtk9 xvfb xauth libgl1-mesa-dri"
# The deal.II of Debian 13 links with mold, which is not among its dependencies.
[[ "$(cat /etc/debian_version 2>/dev/null)" != 13* ]] || packages="$packages mold"

install_packages()
{
  local missing=""
  for package in $packages; do
    dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
  done
  [ -z "$missing" ] && return
  local as_root=""
  [ "$(id -u)" -eq 0 ] || as_root="sudo"
  if ! command -v apt-get >/dev/null; then
    echo "These packages of Debian are missing, and there is no apt-get to install them:$missing" >&2
    echo "doc/how_to/install.md says how to install Ricochet elsewhere." >&2
    exit 1
  elif ! $as_root true 2>/dev/null; then
    echo "Packages are missing, and this user is neither root nor allowed to use sudo." >&2
    echo "An administrator has to run: apt-get install$missing" >&2
    exit 1
  fi
  echo "Installing:$missing"
  $as_root apt-get update -qq
  $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# configure PRESET: prepare the build of that name in CMakePresets.json, in build/PRESET.
configure()
{
  local log
  log="$(cmake --preset "$1")" || { echo "$log"; exit 1; }
}

# build PRESET: configure and build.
build()
{
  configure "$1"
  ninja -C "build/$1"
}

# One thread per process; Open MPI as root and with more ranks than cores.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
# All runs are on this machine: a program that does not look for networks starts
# sooner. Containers may not let one process read the memory of another.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader
export OMPI_MCA_btl_vader_single_copy_mechanism=none

install_packages
