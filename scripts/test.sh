#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to all tests passed: install, build, test.
#
#   test.sh           what has to pass before anything is merged (35 to 55 minutes on
#                     2 cores, of which 11 are builds): the debug build with all assertions of deal.II,
#                     and the release build, which also compares with stored outputs
#                     and makes the short ones of the figures, whose numbers are
#                     checked; the site in short
#   test.sh --quick   while you work: the release build, unit tests, stored outputs,
#                     bad input, files (meant to take 8 minutes with the build), format,
#                     and clang-tidy on the C++ that has changed (20 s of a core a file)
#   test.sh --full    once before an issue is closed (some hours): all of the above, the
#                     tests of the release build with the kernels of OpenBLAS for other
#                     processors and without AVX2, all figures, sanitizers, clang-tidy on
#                     all C++, hostile inputs and kills, and deliberate errors in the
#                     library, all of which the tests must find. They come in portions:
#                     TEST_PORTION=2/3 for the second third.

case "${1:-}" in
  "" | --quick | --full) ;;
  *) echo "usage: test.sh [--quick | --full]" >&2; exit 1 ;;
esac
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
packages="clang-format"
[ -z "${1:-}" ] || packages="$packages clang-tidy"
install_packages
# The page of a run is looked at in a browser, where there is one.
packages="chromium"
(install_packages) || echo "There is no browser, so that the page of a run is not looked at."

if [ "${1:-}" = "--quick" ]; then
  build release
  ctest --test-dir build/release --output-on-failure -j 2 -L quick
  scripts/tidy.py
  exit
fi

build debug
build release
# With kernels of OpenBLAS that round in different ways: those of an old processor and those
# of this one.
OPENBLAS_CORETYPE=Nehalem ctest --test-dir build/debug --output-on-failure -j 2
ctest --test-dir build/release --output-on-failure -j 2
bash scripts/docs.sh --short --build-dir build/release

if [ "${1:-}" = "--full" ]; then
  # Each three choices, and not only each two, in integration/covering_array.
  export RICOCHET_FULL=1
  for kernels in Nehalem:sse4_2 Sandybridge:avx Haswell:avx2 Zen:avx2 SkylakeX:avx512f; do
    grep -qw "${kernels#*:}" /proc/cpuinfo || continue
    echo "kernels of OpenBLAS: ${kernels%:*}"
    OPENBLAS_CORETYPE="${kernels%:*}" ctest --test-dir build/release --output-on-failure -j 2
  done
  build without_avx2
  ctest --test-dir build/without_avx2 --output-on-failure -j 2
  figures/make.py all
  figures/hertz_impact.py
  examples/check.py
  bash scripts/sanitize.sh
  scripts/tidy.py --all
  tests/hostile/hostile.py --programs build/release --inputs 2000 --kills 300
  tests/mutations/mutations.py --source . --build-dir build/mutations \
    --portion "${TEST_PORTION:-1/3}"
fi
