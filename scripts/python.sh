#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the virtual environment of the tests that need packages from PyPI, build/python: those of the Python package
# (python/tests) and those that exchange files with Gmsh and meshio (tests/peers). Where that is impossible, for want of a
# network say, the Python module is not built and these tests are skipped.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

requirements=$project/python/tests/requirements.txt
if cmp --quiet "$requirements" "$python_environment/requirements.txt"; then
  exit 0
fi
if python3 -m venv "$python_environment" &&
  "$python_environment/bin/pip" install --quiet --disable-pip-version-check --requirement "$requirements"; then
  cp "$requirements" "$python_environment/requirements.txt"
else
  echo "note: packages from PyPI could not be installed; the tests that need them are skipped" >&2
fi
