#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to pictures: install, build, run all figures.

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
build Release

for bar in bar_sd bar_ss; do
  build/release/$bar parameter_files/$bar/default.prm --quiet
done
figures/make.py all

echo
echo "Pictures:      output/figures/index.html (and *.png beside it)"
echo "For ParaView:  output/bar_sd/solution.pvd, output/bar_ss/solution.pvd"
echo "Energy curves: output/bar_sd/energy.csv, output/bar_ss/energy.csv"
