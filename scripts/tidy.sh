#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy with the project's .clang-tidy:
#
#   scripts/tidy.sh                    over all sources
#   scripts/tidy.sh FILE...            over those named
#   scripts/tidy.sh --changed [REF]    over those that differ from commit REF. Without REF: from where the branch left
#                                      origin's, or on origin's itself those of the last commit
#
# Debian's clang-tidy 14 cannot read the headers of CUDA 13: PyPI has a newer one, which build/tidy/tool keeps.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
version=23.1.4

files=()
if [[ ${1:-} == --changed ]]; then
  cd "$project"
  mapfile -t files < <(git diff --name-only --diff-filter=d "$(start_of_changes "${2:-}")" -- '*.cpp' '*.cu')
  if ((${#files[@]} == 0)); then
    echo "clang-tidy: no source has changed"
    exit
  fi
else
  for file in "$@"; do
    files+=("$(realpath --relative-to "$project" "$file")")
  done
  cd "$project"
  if ((${#files[@]} == 0)); then
    mapfile -t files < <(git ls-files '*.cpp' '*.cu')
  fi
fi

# A configuration of its own: every source has its own compile command.
build=$project/build/tidy
# shellcheck disable=SC2046 # several options
cmake --preset release -B "$build" --log-level=ERROR -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON $(python_options)
tidy=$build/tool/bin/clang-tidy
if [[ $("$tidy" --version 2>/dev/null) != *"$version"* ]]; then
  python3 -m venv "$build/tool"
  "$build/tool/bin/pip" install --quiet "clang-tidy==$version"
fi

# What is compiled for the host alone: the compile commands are GCC's, and Clang need not know every warning and limit that
# they name. Sources that this machine does not build are left out, and said.
sources=()
kernels=()
unbuilt=0
for file in "${files[@]}"; do
  if [[ $file == *.cu ]]; then
    kernels+=("$file")
  elif grep --quiet --fixed-strings "\"file\": \"$project/$file\"" "$build/compile_commands.json"; then
    sources+=("$file")
  else
    unbuilt=$((unbuilt + 1))
  fi
done
# The analyzer follows a function's paths for so long: by itself it takes nine tenths of the time, for functions that print.
# TRISMOOTH_THOROUGH=1 lets it go on for as long as it wants.
patience=()
if [[ -z ${TRISMOOTH_THOROUGH:-} ]]; then
  patience=(--extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=max-nodes=40000)
fi
echo "clang-tidy: ${#sources[@]} C++ and ${#kernels[@]} CUDA sources; $unbuilt that are not built here"
status=0
if ((${#sources[@]} > 0)); then
  printf '%s\0' "${sources[@]}" |
    xargs -0 -n 1 -P "$(nproc)" "$tidy" --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option \
      --extra-arg=-Wno-unused-command-line-argument "${patience[@]}" || status=1
fi
# Kernels as Clang compiles them for the host; nvcc's options are not its own.
cuda=$(dirname "$(dirname "$(realpath "$(command -v nvcc || echo /usr/local/cuda/bin/nvcc)")")")
if ((${#kernels[@]} > 0)) && [[ -d $cuda/include ]]; then
  printf '%s\0' "${kernels[@]}" |
    xargs -0 -I{} -P "$(nproc)" "$tidy" --quiet {} -- -x cuda --cuda-host-only "--cuda-path=$cuda" -std=c++20 \
      -ffp-contract=off -Wno-unknown-cuda-version --cuda-gpu-arch=sm_90 -fgpu-rdc -Wno-undefined-internal \
      -I"$build/include" -I"$build/public" -I"$project/tests" -isystem "$cuda/include/cccl" || status=1
fi
exit "$status"
