#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds what a user runs and runs the tests, in 12 to 25 minutes on two processors. Arguments go to ctest:
#
#   scripts/test.sh
#   scripts/test.sh -R never_worse
#
# The CUDA part and the tests that need a GPU are built where there is one; with TRISMOOTH_CUDA=ON in the environment the
# CUDA part is built wherever there is nvcc. Random tests take a part of their meshes, and tests that break the program
# off at many moments take a part of these; TRISMOOTH_THOROUGH=1 has them take all. Where nothing has changed that
# packages depend on, their tests are left out, unless TRISMOOTH_THOROUGH=1 or an argument asks for them.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

SECONDS=0
"$project/scripts/install-deps.sh" --tests
"$project/scripts/python.sh"
# -U: as CMake finds them, whatever scripts/demo.sh has said.
# shellcheck disable=SC2046 # several options
configure "$(cuda_option)" -UTRISMOOTH_MPI -UTRISMOOTH_METIS -DTRISMOOTH_BENCHMARKS=OFF \
  "-DTRISMOOTH_CUDA_TESTS=$(has_gpu && echo ON || echo OFF)" $(python_options)
configured=$SECONDS
build_target all
built=$SECONDS
echo "Set-up took $configured s, the build $((built - configured)) s. Tests:"
keep_temporary_files_in_memory
if [[ -z ${TRISMOOTH_THOROUGH:-} ]]; then
  # Per cent of the random meshes.
  export TRISMOOTH_MESHES=${TRISMOOTH_MESHES:-30}
fi
left_out=()
if (($# == 0)) && [[ -z ${TRISMOOTH_THOROUGH:-} && -z $(change_of_packaging) ]]; then
  left_out=(--label-exclude '^packaging$')
fi
# One more than there are processors: what runs over ranks waits a good deal for its launcher.
ctest --test-dir "$build" --output-on-failure -j "$(($(nproc) + 1))" "${left_out[@]}" "$@"
if ((${#left_out[@]} > 0)); then
  echo "Skipped: the tests of packages and of what is installed: $packaging_left_out."
fi
if [[ $(cuda_option) == *=OFF ]]; then
  echo "Skipped: the CUDA part, for want of a GPU; TRISMOOTH_CUDA=ON has it built and tested as far as that goes without one."
fi
echo "Set-up took $configured s, the build $((built - configured)) s, the tests $((SECONDS - built)) s."
