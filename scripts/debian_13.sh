#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Does it build with Debian 13 (deal.II 9.6, SUNDIALS 7), are the unit tests passed, and are the
# stored outputs reproduced?
#
#   debian_13.sh           on Debian 13
#   debian_13.sh FOLDER    on Debian 12, as root: makes a Debian 13 in FOLDER (8 GB), copies the
#                          sources there and does the same in it; existing parts are used again

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ $# -eq 0 ]; then
  source scripts/setup.sh
  build release
  build/release/tests/unit_tests
  scripts/compare_outputs.sh build/release
  exit
fi
[ $# -eq 1 ] || { echo "usage: debian_13.sh [FOLDER]" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || { echo "debian_13.sh: has to be run as root" >&2; exit 1; }
folder="$1"

if [ ! -e "$folder/etc/debian_version" ]; then
  apt-get update -qq
  command -v debootstrap >/dev/null || apt-get install -y -qq debootstrap
  # The mirror is that of this machine, in whatever form its sources are written.
  mirror="$(apt-get indextargets --format '$(REPO_URI)' "Created-By: Packages" "Label: Debian" |
    sed -n 1p)"
  debootstrap --variant=minbase trixie "$folder" "${mirror:?no source of packages is Debian}"
fi
mkdir -p "$folder/src"
git ls-files -z | tar --null -T - -c | tar -x -C "$folder/src"

# In a mount namespace of its own, so that nothing stays mounted.
unshare -m bash -c '
  set -euo pipefail
  for each in proc dev sys; do mount --rbind /$each "$1/$each"; done
  chroot "$1" bash /src/scripts/debian_13.sh
' debian_13 "$folder"
