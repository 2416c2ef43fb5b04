#!/usr/bin/env bash
# Builds everything and runs the tests. Arguments go to ctest: scripts/test.sh -R never_worse
# ctest's summary, with the time that the tests took, is the last thing printed.
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
exec ctest --test-dir "$build" --output-on-failure -j2 "$@"
