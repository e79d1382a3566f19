#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The numerical regressions with another version of deal.II than that of the stored outputs,
# whose first lines name it: compares all lines but those.
#
#   compare_outputs.sh BUILD_FOLDER

[ $# -eq 1 ] || { echo "usage: compare_outputs.sh BUILD_FOLDER" >&2; exit 1; }
build="$(realpath "$1")"
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# Their meshes are others with other versions: of Gmsh, and of deal.II's disks.
others="colliding_disks/head_on colliding_disks/oblique_friction colliding_spheres/oblique_spin"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failed=0
for stored in tests/*/*.release.output; do
  name="${stored#tests/}"
  name="${name%.release.output}"
  case " $others " in *" $name "*) echo "$name: another mesh, left out"; continue ;; esac
  [[ "$name" != *mpirun* ]] || continue
  program="$(dirname "$name")"
  (cd "$work" && "$build/$program" "$OLDPWD/tests/$name.prm" --overwrite) >"$work/new"
  if tests/compare_outputs.py "$stored" "$work/new"; then
    echo "$name: the same"
  else
    echo "$name: DIFFERENT"
    failed=1
  fi
done
exit $failed
