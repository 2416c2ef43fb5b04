#!/usr/bin/env bash
# Builds everything and runs the tests, then the sanitizers (scripts/sanitize.sh). With arguments, which go to ctest,
# the tests alone: scripts/test.sh -R never_worse
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

SECONDS=0
"$project/scripts/install-deps.sh" --tests
configure
configured=$SECONDS
build_target all
built=$SECONDS
echo "Set-up took $configured s, the build $((built - configured)) s. Tests:"
keep_temporary_files_in_memory
ctest --test-dir "$build" --output-on-failure -j2 "$@"
if (($# == 0)); then
  tested=$SECONDS
  "$project/scripts/sanitize.sh"
  echo "Set-up took $configured s, the build $((built - configured)) s, the tests $((tested - built)) s," \
    "the sanitizers $((SECONDS - tested)) s."
fi
