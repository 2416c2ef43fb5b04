#!/usr/bin/env bash
# Builds everything and runs the tests, then what scripts/sanitize.sh has. With arguments, which go to ctest, those
# tests alone: scripts/test.sh -R never_worse
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
ctest --test-dir "$build" --output-on-failure -j2 "$@"
if (($# == 0)); then
  echo "The tests are done after $SECONDS s. Sanitizers:"
  "$project/scripts/sanitize.sh"
  echo "All is done after $SECONDS s."
fi
