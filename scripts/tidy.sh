#!/usr/bin/env bash
# Runs clang-tidy 14 with the project's .clang-tidy over all sources, or over those named:
#
#   scripts/tidy.sh [FILE]...
set -euo pipefail
files=()
for file in "$@"; do
  files+=("$(realpath "$file")")
done
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tidy=$(command -v clang-tidy-14 || command -v clang-tidy || true)
if [[ -z $tidy ]]; then
  echo "error: clang-tidy is not installed; scripts/install-deps.sh --tools installs it" >&2
  exit 2
fi

# A configuration of its own: every source has its own compile command.
build=$project/build/tidy
cd "$project"
cmake --preset release -B "$build" --log-level=ERROR -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
if ((${#files[@]} == 0)); then
  # Sources that are built, and of this project. compile_commands.json is one line an entry.
  mapfile -t files < <(sed -n 's/^ *"file": "\(.*\.cpp\)",\{0,1\}$/\1/p' "$build/compile_commands.json" | sort -u)
fi
# The compile commands are GCC's: Clang need not know every warning that they name.
printf '%s\0' "${files[@]}" |
  xargs -0 -r -n 1 -P "$(nproc)" "$tidy" --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option
