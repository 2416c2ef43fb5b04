#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the documentation as a site, of the pages and the public headers:
#
#   scripts/docs.sh [PROGRAM]   into build/docs/site, with the reports that PROGRAM makes of the example meshes; without it
#                               the one in build/release, if it has been built
#
# The site is static files, for a server or to be opened from the disk. Fails for what Doxygen and Sphinx warn of: links that
# lead nowhere, pages of docs/ that docs/conf.py has not in its navigation.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
program=$(realpath --canonicalize-missing "${1:-$build/pipeline/trismooth}")

"$project/scripts/install-deps.sh" --docs
cd "$project"
output=build/docs
tool=$output/tool
environment_with "$tool" docs/requirements.txt
find "$output" -mindepth 1 -maxdepth 1 -not -name tool -exec rm -rf {} +

# The public headers. Doxygen would take instances of templates for functions of their own, and a page for what a header has
# is only made where it says so.
include=$output/include/trismooth
mkdir -p "$include"
public_headers |
  while read -r header; do
    mkdir -p "$(dirname "$include/$header")"
    case $header in
      trismooth.h) cat cmake/trismooth.h ;;
      version.h) cat cmake/version.h.in ;;
      *) sed '/^extern template/d' "$header" ;;
    esac >"$include/$header"
    echo "/// @file" >>"$include/$header"
  done
{
  cat docs/Doxyfile
  echo "OUTPUT_DIRECTORY = $output"
  echo "WARN_LOGFILE = $output/warnings.txt"
  echo "GENERATE_TAGFILE = $output/api.xml"
  echo "INPUT = docs/namespaces.dox $output/include"
} | doxygen -

# Classes and functions have comments. Where the name of a variable, a macro, an operator or a move says all, there need be
# none, and the text forms of enumerations are all alike.
says_all='\((variable|macro definition)\)|\(typedef\)|\boperator|&&\) noexcept|(EnumText|NumberTuple)<'
if grep --extended-regexp --invert-match "($says_all).* is not documented" "$output/warnings.txt" >&2; then
  echo "error: Doxygen warns, see above" >&2
  exit 1
fi

# The pages are made of a copy of the tree, in which the pages below have a place.
pages=$output/pages
mkdir -p "$pages/api" "$pages/reports" "$output/reports"
tar --create --exclude='./build*' --exclude=./out --exclude='./.*' . | tar --extract --directory "$pages"
# Doxygen's own takes its place.
echo "# Headers, classes and functions" >"$pages/api/index.md"
{
  echo "# Reports of the examples"
  echo
  if [[ -x $program ]]; then
    echo "What \`trismooth smooth\` says of the [example meshes](../examples/data/README.md):"
    echo
    echo "| report | command |"
    echo "|---|---|"
    ln -s "$project/examples" "$output/reports"
    for mesh in examples/data/*.{off,vtu,vtk,msh,su2,14}; do
      name=$(basename "$mesh")
      command=(smooth "$mesh" "$name" --report "${name%.*}.html")
      if [[ $name == *.14 ]]; then
        command+=(--geographic)
      fi
      (cd "$output/reports" && "$program" "${command[@]}" --quiet)
      echo "| <a href=\"${name%.*}.html\">$name</a> | \`trismooth ${command[*]}\` |"
    done
  else
    echo "They are left out here, as the program had not been built; \`scripts/demo.sh\` builds it, and \`scripts/docs.sh\`"
    echo "makes this site with them."
  fi
} >"$pages/reports/index.md"

site=$output/site
"$tool/bin/sphinx-build" --quiet --fail-on-warning --jobs auto --conf-dir docs --doctree-dir "$output/doctrees" \
  "$pages" "$site"
# Doxygen takes no link for its head.
sed --in-place 's#\(<div id="projectbrief">\)\(.*\)</div>#\1<a href="../index.html">\2</a></div>#' "$output"/api/*.html
cp -r "$output/api" "$site"
find "$output/reports" -name '*.html' -exec cp {} "$site/reports" \;
# Where servers look first.
cp "$site/README.html" "$site/index.html"
echo "Open $project/$site/index.html"
