#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to all tests passed: install, build, test. The debug
# build runs with all assertions of deal.II; the release build also compares with
# stored outputs and makes the figures, whose numbers are checked.

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
build Debug
build Release
ctest --test-dir build/debug --output-on-failure -j 2
ctest --test-dir build/release --output-on-failure -j 2
