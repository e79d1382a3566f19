#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Does it build with Debian 13 (deal.II 9.6, SUNDIALS 7), and are the unit tests passed? On
# Debian 12, as root: makes a Debian 13 in FOLDER (8 GB), copies the sources there, builds and
# tests them. Existing parts are used again.
#
#   debian_13.sh FOLDER

set -euo pipefail
[ $# -eq 1 ] || { echo "usage: debian_13.sh FOLDER" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || { echo "debian_13.sh: has to be run as root" >&2; exit 1; }
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder="$1"

command -v debootstrap >/dev/null || { apt-get update -qq && apt-get install -y -qq debootstrap; }
[ -e "$folder/etc/debian_version" ] ||
  debootstrap --variant=minbase trixie "$folder" http://deb.debian.org/debian
mkdir -p "$folder/src"
git ls-files -z | tar --null -T - -c | tar -x -C "$folder/src"

# In a mount namespace of its own, so that nothing stays mounted. Its deal.II links with mold,
# which is not among its dependencies.
unshare -m bash -c '
  set -euo pipefail
  for each in proc dev sys; do mount --rbind /$each "$1/$each"; done
  chroot "$1" bash -c "
    set -euo pipefail
    cd /src
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends mold
    bash -c \"source scripts/setup.sh; build release\"
    source scripts/setup.sh
    build/release/tests/unit_tests
    scripts/compare_outputs.sh build/release"
' debian_13 "$folder"
