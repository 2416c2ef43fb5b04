# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Sourced by the other scripts: where the project is, and how they all configure it.
# One place, so that whatever one script has built is up to date for the next.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Used by the scripts that source this file.
# shellcheck disable=SC2034
build=$project/build/release

# The virtual environment of scripts/python.sh.
# shellcheck disable=SC2034
python_environment=$project/build/python

# environment_with FOLDER REQUIREMENTS: a virtual environment with the packages from PyPI that the file lists. Where they are
# there already, nothing is done.
environment_with() {
  cmp --quiet "$2" "$1/requirements.txt" ||
    { python3 -m venv "$1" && "$1/bin/pip" install --quiet --disable-pip-version-check --requirement "$2" &&
      cp "$2" "$1/requirements.txt"; }
}

# Warnings are errors with the compiler that the project is developed with. Another one may warn of other things, and
# that must not keep anybody from building. TRISMOOTH_WERROR=ON or OFF in the environment decides otherwise.
warnings_as_errors() {
  if [[ -n ${TRISMOOTH_WERROR:-} ]]; then
    echo "$TRISMOOTH_WERROR"
  elif [[ $("${CXX:-c++}" -dumpversion 2>/dev/null) == 12* ]]; then
    echo ON
  else
    echo OFF
  fi
}

# One architecture is enough for this machine, and takes half the time of the two that a build by hand compiles for:
# that of its GPU, or 90, the newer, where there is none. TRISMOOTH_CUDA_ARCHITECTURES="80;90" in the environment decides
# otherwise.
cuda_architectures() {
  local own
  own=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -1 | tr -dc '0-9' || true)
  echo "${TRISMOOTH_CUDA_ARCHITECTURES:-${own:-90}}"
}

has_gpu() {
  nvidia-smi --list-gpus >/dev/null 2>&1
}

# The option that has the CUDA part built where a GPU would use it: compiling it takes as long as all the rest. With
# TRISMOOTH_CUDA=ON in the environment it is built wherever CMake finds nvcc.
cuda_option() {
  if has_gpu || [[ ${TRISMOOTH_CUDA:-} == ON ]]; then
    echo "-UTRISMOOTH_CUDA"
  else
    echo "-DTRISMOOTH_CUDA=OFF"
  fi
}

# GCC collects its garbage when its memory has grown by so much per cent beyond so many kilobytes: later than it would by
# itself, which spares a tenth of its time.
patient_garbage_collection() {
  if "${CXX:-c++}" --version 2>/dev/null | grep --quiet 'Free Software Foundation'; then
    echo "--param=ggc-min-expand=100 --param=ggc-min-heapsize=500000"
  fi
}

# configure [OPTION]...: several sources are compiled as one, which takes half the time.
configure() {
  (cd "$project" && cmake --preset release "-DTRISMOOTH_WERROR=$(warnings_as_errors)" \
    "-DCMAKE_CUDA_ARCHITECTURES=$(cuda_architectures)" --no-warn-unused-cli \
    "-DCMAKE_CXX_FLAGS=${CXXFLAGS:-} $(patient_garbage_collection)" \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=24 -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "$@")
}

# The options that have the Python module built, where its environment is there.
python_options() {
  if [[ -f $python_environment/requirements.txt ]]; then
    echo "-DTRISMOOTH_PYTHON=ON -DPython_EXECUTABLE=$python_environment/bin/python"
  else
    echo "-DTRISMOOTH_PYTHON=OFF"
  fi
}

build_target() {
  (cd "$project" && cmake --build --preset release --target "$1")
}

# start_of_changes [REF [ELSE]]: the commit from which changes count: REF, or where the branch left origin's. On origin's
# own branch, or without origin: ELSE, or the commit before the last one.
start_of_changes() {
  local base
  base=$(git -C "$project" merge-base HEAD origin/HEAD 2>/dev/null || true)
  if [[ -n ${1:-} ]]; then
    base=$1
  elif [[ -z $base || $base == "$(git -C "$project" rev-parse HEAD)" ]]; then
    base=${2:-HEAD~1}
  fi
  echo "$base"
}

# The public headers, as CMake has them, by their paths below trismooth/.
public_headers() {
  find "$project" -name CMakeLists.txt -not -path "$project/build*" -exec cat {} + | tr '\n' ' ' |
    grep --only-matching 'trismooth_public_headers([^)]*)' | grep --only-matching '[a-z0-9_/]*\.h\b'
}

# change_of_packaging: the first file that has changed and that packages, installed copies and projects with trismooth as
# a part depend on. Nothing where there is none. Where no branch says what belongs to the change, it is the work of eight
# hours; where git does not know, anything may have changed.
change_of_packaging() {
  local eight_hours older changed
  eight_hours=$(($(git -C "$project" show --no-patch --format=%ct HEAD 2>/dev/null || echo 0) - 8 * 3600))
  older=$(git -C "$project" rev-list --max-count=1 "--before=$eight_hours" HEAD 2>/dev/null || true)
  if ! changed=$(cd "$project" && git diff --name-only "$(start_of_changes "" "${older:-unknown}")" -- 2>/dev/null &&
    git ls-files --others --exclude-standard); then
    echo "git does not say what has changed"
    return
  fi
  grep --extended-regexp --max-count=1 \
    '^(\.ci|cmake|python|scripts|tests/install)/|(^|/)CMakeLists\.txt$|^(CMakePresets\.json|pyproject\.toml)$' <<<"$changed" ||
    grep --fixed-strings --line-regexp --max-count=1 --file=<(public_headers) <<<"$changed" || true
}

# What is said where tests of packaging do not run.
# shellcheck disable=SC2034 # used by the scripts that source this file
packaging_left_out="nothing that packages depend on has changed (cmake/, python/, scripts/, a CMakeLists.txt, a public \
header); TRISMOOTH_THOROUGH=1 has them run"

# Tests write thousands of small files, and the program waits for the disk with each. Where memory has a gigabyte to
# spare, their temporary folder is there until the script ends.
keep_temporary_files_in_memory() {
  local free
  free=$(df --output=avail /dev/shm 2>/dev/null | tail -1 || true)
  if [[ -z ${TMPDIR:-} && -w /dev/shm ]] && ((${free:-0} > 1 << 20)); then
    TMPDIR=$(mktemp -d /dev/shm/trismooth.XXXXXX)
    export TMPDIR
    trap 'rm -rf "$TMPDIR"' EXIT
  fi
}
