#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what the project needs to be built and tested on Debian 12 and Ubuntu 24.04, as far as it is missing.
#
#   scripts/install-deps.sh            compiler, CMake, libraries
#   scripts/install-deps.sh --tests    also what single tests need: a locale, strace, valgrind, a browser, Python's headers,
#                                      what Gmsh links
#   scripts/install-deps.sh --package  also what the target `package` makes a .deb with
#   scripts/install-deps.sh --tools    also Clang with its sanitizers, clang-format and a venv for clang-tidy
#   scripts/install-deps.sh --docs     also Doxygen, and what a venv for Sphinx takes
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config python3
  libvtk9-dev libopenmesh-dev libeigen3-dev libtbb-dev
  libfmt-dev libcli11-dev nlohmann-json3-dev libexpat1-dev libhdf5-dev libxxhash-dev libpng-dev zlib1g-dev
  libopenmpi-dev openmpi-bin libmetis-dev
  catch2
)

case "${1:-}" in
  '') ;;
  --tests)
    # The last two lines are for Gmsh from PyPI.
    packages+=(
      dpkg-dev locales strace valgrind
      python3-venv python3-dev libgl1 libglu1-mesa libgomp1 libfontconfig1 libfreetype6 libx11-6 libxcursor1 libxext6 libxfixes3
      libxft2 libxinerama1 libxrender1
    )
    # Ubuntu has it as a snap only: there that test is skipped.
    if grep --quiet --no-messages '^ID=debian$' /etc/os-release; then
      packages+=(chromium)
    fi
    ;;
  --package) packages+=(dpkg-dev) ;;
  --tools) packages+=(clang libclang-rt-dev llvm clang-format-14 python3-venv) ;;
  --docs) packages+=(doxygen python3-venv) ;;
  *)
    echo "usage: install-deps.sh [--tests|--package|--tools|--docs]" >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "note: this is no Debian or Ubuntu; please make sure that you have what these packages hold:" >&2
  echo "  ${packages[*]}" >&2
  exit 0
fi

is_installed() {
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing=()
for package in "${packages[@]}"; do
  if ! is_installed "$package"; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "error: these packages are missing and only root can install them (there is no sudo):" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

# env behind sudo: sudo itself drops the variable.
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
  apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 --quiet)
echo "Installing: ${missing[*]}"
"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}"
