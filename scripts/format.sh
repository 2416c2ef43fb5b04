#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Formats all C++ and CUDA sources with clang-format 14. Other versions format differently. And sees to it that every
# source names the licence in its first lines, as tools that list licences read it.
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
# shellcheck disable=SC2046 # names of sources have no spaces
unnamed=$(grep --files-without-match '^\(//\|#\) SPDX-License-Identifier: BSD-3-Clause$' $(git ls-files \
  '*.h' '*.cpp' '*.cuh' '*.cu' '*.py' '*.pyi' '*.sh' '*.cmake' '*.cmake.in' '*.h.in' '*CMakeLists.txt' .ci/run) || true)
if [[ -n $unnamed ]]; then
  echo "$unnamed" >&2
  echo "error: these files lack the line \"SPDX-License-Identifier: BSD-3-Clause\"; the first line of others has it" >&2
  exit 1
fi
find base space quality smoothing mesh_io cuda mpi pipeline paper python tests examples benchmarks -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cuh' -o -name '*.cu' \) -print0 |
  xargs -0 -r -n 16 -P "$(nproc)" "$formatter" "${mode[@]}"
