#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to pictures: install, build, run all figures.

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
build Release

for program in bar_sd bar_ss elastic_ball hyperelastic_ring sphere; do
  build/release/$program parameter_files/$program/default.prm --quiet
done
figures/make.py all

echo
echo "Pictures:      output/figures/index.html (and *.png beside it)"
echo "For ParaView:  output/*/solution.pvd, say output/hyperelastic_ring/solution.pvd"
echo "Energy curves: output/*/energy.csv"
