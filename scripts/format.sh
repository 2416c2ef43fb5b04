#!/usr/bin/env bash
# Formats all C++ and CUDA sources with clang-format 14. Other versions format differently.
#
#   scripts/format.sh            changes the files
#   scripts/format.sh --check    changes nothing; fails and names the places where something would change
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-}" in
  '') mode=(-i) ;;
  --check) mode=(--dry-run --Werror) ;;
  *)
    echo "usage: format.sh [--check]" >&2
    exit 2
    ;;
esac

formatter=
for candidate in clang-format-14 clang-format; do
  if [[ $("$candidate" --version 2>/dev/null) == *' version 14.'* ]]; then
    formatter=$candidate
    break
  fi
done
if [[ -z $formatter ]]; then
  echo "error: clang-format 14 is not installed; scripts/install-deps.sh --tools installs it" >&2
  exit 2
fi

cd "$project"
find base space quality smoothing mesh_io cuda mpi pipeline paper python tests examples benchmarks -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cuh' -o -name '*.cu' \) -print0 |
  xargs -0 -r -n 16 -P "$(nproc)" "$formatter" "${mode[@]}"
