#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Build with the address and undefined-behaviour sanitizers of the compiler, and run
# the unit tests and a short run of each program. Any report ends it with an error.

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
build sanitize

# Leaks are those of MPI and Gmsh; containers that the libraries (which are not
# instrumented) made or filled would be taken for overflows.
export ASAN_OPTIONS=detect_leaks=0:detect_container_overflow=0:abort_on_error=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export OMPI_MCA_ess_singleton_isolated=1
programs=build/sanitize
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT

$programs/tests/unit_tests
run()
{
  echo "sanitize: $*"
  local overwrite=--overwrite
  [[ " $* " == *" --resume "* ]] && overwrite=
  "$programs/$1" "${@:2}" --quiet $overwrite --output-dir "$runs/$1" \
    --set "Output/Checkpoint every=5" --set "Output/Fields every=2"
}
run bar_sd --set "Time/Final time=2"
run bar_ss --set "Time/Final time=2" --set "Time/Scheme=TR-BDF2" \
  --set "Contact/Treatment=proximal augmented Lagrangian" --set "Time/Mass=redistributed"
run bar_ss --resume --set "Time/Final time=3" --set "Time/Scheme=TR-BDF2" \
  --set "Contact/Treatment=proximal augmented Lagrangian" --set "Time/Mass=redistributed"
run elastic_ball --set "Mesh/Nodes=392" --set "Mesh/Boundary nodes=64" \
  --set "Start/Initial gap=0.0155" --set "Time/Final time=0.02" \
  --set "Contact/Treatment=persistent contact" --set "Contact/Friction coefficient=0.2"
run hyperelastic_ring --set "Mesh/Nodes around=32" --set "Mesh/Nodes across=3" \
  --set "Start/Initial gap=0.05" --set "Time/Final time=0.2" \
  --set "Material/Viscosity=Pioletti" --set "Material/Viscosity eta=100"
run sphere --set "Mesh/Mesh size=10" --set "Time/Final time=8" --set "Time/Time step=1"
run sphere --set "Mesh/File=meshes/sphere_h4.msh" --set "Mesh/Degree=1" \
  --set "Time/Final time=2" --set "Linear solver/Type=multigrid"
run colliding_spheres --set "Spheres/Mesh size of the left sphere=0.8" \
  --set "Spheres/Mesh size of the right sphere=0.9" --set "Spheres/Speed=2" \
  --set "Contact/Friction coefficient=0.3" --set "Time/Final time=0.06"
run colliding_disks --set "Disks/Rings of the left disk=4" \
  --set "Disks/Rings of the right disk=3" --set "Disks/Offset=1" \
  --set "Time/Final time=0.1" --set "Contact/Treatment=improved normal compliance" \
  --set "Contact/Friction coefficient=0.2"
run colliding_disks --set "Disks/Rings of the left disk=4" \
  --set "Disks/Rings of the right disk=3" --set "Material/Law=linear elastic" \
  --set "Time/Final time=0.1" --set "Contact/Treatment=proximal augmented Lagrangian" \
  --set "Contact/Augmentation=2e7" --set "Contact/Coupling=cut faces"
run hyperelastic_ring parameter_files/hyperelastic_ring/feels_itself.prm \
  --set "Mesh/Nodes around=48" --set "Mesh/Nodes across=3" --set "Time/Time step=2e-2" \
  --set "Time/Final time=1.6" --set "Contact/Treatment=Signorini active set"
run stent_artery --set "Geometry/Artery nodes along=31" \
  --set "Geometry/Artery nodes across=4" --set "Geometry/Stent nodes along=41" \
  --set "Geometry/Stent nodes across=3" --set "Geometry/Gap=0.001" \
  --set "Time/Final time=0.4" --set "Contact/Friction coefficient=0.2"
run sliding_block --set "Time/Final time=0.02"
for treatment in "Nitsche" "penalty" "Signorini active set"; do
  "$programs/bar_by_hand" --quiet --overwrite --output-dir "$runs/bar_by_hand" \
    --set "Contact/Treatment=$treatment" --set "Time/Final time=2"
done
"$programs/disk_step_by_step" --quiet --output-dir "$runs/disk" --set "Mesh/Nodes=392" \
  --set "Mesh/Boundary nodes=64" --set "Start/Initial gap=0.0155" --set "Time/Final time=0.02"
"$programs/spectral_radius" --quiet --output-dir "$runs/spectral" --set "Spectrum/Points=5"
echo "sanitize: no reports"
