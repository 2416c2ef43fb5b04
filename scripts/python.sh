#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the virtual environment of the tests that need packages from PyPI, build/python: those of the Python package
# (python/tests) and those that exchange files with Gmsh and meshio (tests/peers). Where that is impossible, for want of a
# network say, the Python module is not built and these tests are skipped.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if ! environment_with "$python_environment" "$project/python/tests/requirements.txt"; then
  echo "note: packages from PyPI could not be installed; the tests that need them are skipped" >&2
fi
