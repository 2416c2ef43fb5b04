#!/usr/bin/env bash
# Installs Gmsh and meshio from PyPI into a virtual environment, build/peers, for the tests that exchange files with them
# (tests/peers). Where that is impossible, for want of a network say, those tests are skipped.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

venv=$project/build/peers
requirements=$project/tests/peers/requirements.txt
if cmp --quiet "$requirements" "$venv/requirements.txt"; then
  exit 0
fi
if python3 -m venv "$venv" &&
  "$venv/bin/pip" install --quiet --disable-pip-version-check --requirement "$requirements"; then
  cp "$requirements" "$venv/requirements.txt"
else
  echo "note: Gmsh and meshio could not be installed; the tests that need them are skipped" >&2
fi
