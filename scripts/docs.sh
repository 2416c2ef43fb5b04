#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the documentation as pages to read in a browser, of README.md, docs/ and the public headers:
#
#   scripts/docs.sh      into build/docs/html; fails for what Doxygen warns of
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$project/scripts/install-deps.sh" --docs
cd "$project"
output=build/docs
include=$output/include/trismooth
rm -rf "$output"
mkdir -p "$include"
# Doxygen would take instances of templates for functions of their own.
public_headers |
  while read -r header; do
    mkdir -p "$(dirname "$include/$header")"
    case $header in
      trismooth.h) cp cmake/trismooth.h "$include" ;;
      version.h) cp cmake/version.h.in "$include/version.h" ;;
      *) sed '/^extern template/d' "$header" >"$include/$header" ;;
    esac
  done
pages=(README.md CONTRIBUTING.md SECURITY.md docs/*.md docs/namespaces.dox)
{
  cat docs/Doxyfile
  echo "OUTPUT_DIRECTORY = $output"
  echo "WARN_LOGFILE = $output/warnings.txt"
  echo "INPUT = ${pages[*]} $output/include"
} | doxygen -

# Classes and functions have comments. Where the name of a variable, an operator or a move says all, there need be none,
# and the text forms of enumerations are all alike.
says_all='\(variable\)|\(typedef\)|\boperator|&&\) noexcept|(EnumText|NumberTuple)<'
if grep --extended-regexp --invert-match "($says_all).* is not documented" "$output/warnings.txt" >&2; then
  echo "error: Doxygen warns, see above" >&2
  exit 1
fi
echo "Open $project/$output/html/index.html"
