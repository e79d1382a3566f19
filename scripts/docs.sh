#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The site, output/doc/index.html, which needs no network: tutorials, figures, methods,
# parameters, results, how to, and the API. It is made of sources and programs, of some short runs,
# and of the figures in output/figures or, where they are not there, those kept in figures/kept.
#
#   docs.sh                     build the programs, then the site
#   docs.sh --build-dir DIR     with programs that are there
#   docs.sh --without-api ...   all but the pages of the API, and links to them
#   docs.sh --short ...         without the runs of tutorials, too: for tests
#
# Warnings are errors, and so are broken links, misspelt words (doc/words.txt has those that are
# right all the same), the idioms of doc/idioms.txt, and formulas that are wider than a narrow
# screen (with Debian's chromium, where it is there).

api=yes short=""
case "${1:-}" in
  --without-api) api=no; shift ;;
  --short) api=no short=--short; shift ;;
esac
case "${1:-}" in
  "") programs="" ;;
  --build-dir) programs="$(realpath "$2")" ;;
  *) echo "usage: docs.sh [--without-api | --short] [--build-dir DIR]" >&2; exit 1 ;;
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
# The site that is there remains until the new one is complete.
site=build/doc/site
rm -rf "$site"
$python doc/make_pages.py --programs "$programs" --to build/doc/source $short
RICOCHET_PROGRAMS="$programs" $python -m sphinx -b html -n -W --keep-going -q -j auto \
  -c doc -d build/doc/doctrees build/doc/source "$site"
if [ "$api" = yes ]; then
  $python doc/make_pages.py --api "$site"
else
  $python doc/make_pages.py --without-api "$site"
fi
$python doc/check_links.py "$site"
$python doc/check_spelling.py "$site"
$python doc/check_width.py "$site"
rm -rf output/doc
mkdir -p output
mv "$site" output/doc
echo "output/doc/index.html, $((SECONDS - begin)) s"
