#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Is all C++ formatted as .clang-format says? Some seconds; ctest runs it as "style/format".
#
#   format.sh          check; unformatted files are named with their first lines
#   format.sh --fix    format
#
# Version 14 judges, that of Debian 12, as others break lines at other places; without it the
# check is skipped (exit code 77).

set -euo pipefail
case "${1:-}" in
  "" | --fix) ;;
  *) echo "usage: format.sh [--fix]" >&2; exit 1 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

clang_format=""
for each in clang-format-14 clang-format; do
  if "$each" --version 2>/dev/null | grep -q "version 14\."; then clang_format="$each"; break; fi
done
if [ -z "$clang_format" ]; then
  echo "format.sh: skipped, as there is no clang-format 14 (on Debian 12: apt-get install clang-format)."
  exit 77
fi

each_source()
{
  find lib steps tests benchmarks examples \( -name '*.cc' -o -name '*.h' \) -print0 |
    xargs -0 -n 50 -P 2 "$clang_format" "$@"
}
if [ "${1:-}" = "--fix" ]; then
  each_source -i
elif ! each_source --dry-run -Werror --ferror-limit=1; then
  echo "format.sh: these files are not formatted as .clang-format says." >&2
  echo "           Format them with: bash scripts/format.sh --fix" >&2
  exit 1
fi
