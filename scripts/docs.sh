#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The site, output/doc/index.html, which needs no network: tutorials, figures, methods,
# parameters, results, how to, and the API. It is made of sources, programs, and of the runs
# and pictures that are in output/; missing ones are listed there.
#
#   docs.sh                     build the programs, then the site
#   docs.sh --build-dir DIR     with programs that are there
#   docs.sh --without-api ...   all but the pages of the API, and links to them
#
# Warnings are errors, and so are broken links, misspelt words (doc/words.txt has those that are
# right all the same), the idioms of doc/idioms.txt, and formulas that are wider than a narrow
# screen (with Debian's chromium, where it is there).

api=yes
[ "${1:-}" != "--without-api" ] || { api=no; shift; }
case "${1:-}" in
  "") programs="" ;;
  --build-dir) programs="$(realpath "$2")" ;;
  *) echo "usage: docs.sh [--without-api] [--build-dir DIR]" >&2; exit 1 ;;
esac
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
packages="python3-sphinx python3-myst-parser python3-nbsphinx python3-ipykernel
  python3-jupyter-client python3-nbconvert pandoc furo libjs-mathjax python3-pil
  aspell aspell-en"
[ "$api" = no ] || packages="$packages doxygen"
install_packages
if [ -z "$programs" ]; then
  build release
  programs="$PWD/build/release"
fi

python=/usr/bin/python3
# A kernel of Jupyter would warn that it is not being debugged.
export PYDEVD_DISABLE_FILE_VALIDATION=1
begin=$SECONDS
rm -rf output/doc
$python doc/make_pages.py --programs "$programs" --to build/doc/source
RICOCHET_PROGRAMS="$programs" $python -m sphinx -b html -n -W --keep-going -q -j auto \
  -c doc -d build/doc/doctrees build/doc/source output/doc
if [ "$api" = yes ]; then
  $python doc/make_pages.py --api output/doc
  $python doc/check_links.py output/doc
else
  $python doc/check_links.py output/doc api
fi
$python doc/check_spelling.py output/doc
$python doc/check_width.py output/doc
echo "output/doc/index.html, $((SECONDS - begin)) s"
