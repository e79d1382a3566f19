#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to pictures: install, build, run. The first picture and the first
# animation, of a ring of rubber thrown at the ground, are there after a few minutes; then come
# the other benchmarks and all figures of the papers.

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

configure release
ninja -C build/release hyperelastic_ring
ring=output/hyperelastic_ring/first_look
build/release/hyperelastic_ring parameter_files/hyperelastic_ring/feels_itself.prm \
  --set "Output/Fields every=20" --set "Time/Final time=5" --output-dir "$ring" --overwrite --quiet
python/bin/ricochet-plot "$ring" --fields --animation gif --frames 60
cat <<END

The first pictures: $ring/plots/
  energies.png, contact_forces.png, fields_von_mises.png, animation_von_mises.gif
For ParaView:       $ring/solution.pvd
Now the rest, which takes about half an hour.

END

ninja -C build/release programs
for program in bar_sd bar_ss elastic_ball hyperelastic_ring sphere; do
  build/release/$program parameter_files/$program/default.prm --quiet
done
figures/make.py all

echo
echo "Pictures:      output/figures/index.html (and *.png beside it), $ring/plots/"
echo "For ParaView:  output/*/solution.pvd, say output/hyperelastic_ring/solution.pvd"
echo "Energy curves: output/*/energy.csv"
