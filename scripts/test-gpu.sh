#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests that need a CUDA device: from a build tree, or from an unpacked package with tests.
#
#   test-gpu.sh [FOLDER]               every program test_cuda* in FOLDER
#   test-gpu.sh --sanitize [FOLDER]    test_cuda_sanitizer under the tools of compute-sanitizer, each of which must
#                                      first find a bug that was planted for it
#
# Without FOLDER: the package that this script lies in, or else build/release of the checkout.
# A program that exits with 77 was skipped, which is not passed. Exit code: 0 all that ran passed, 1 something failed,
# 2 there is nothing to run, 77 all was skipped.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
skip_code=77
# Seconds for one program. A kernel that never ends must not hold the device for ever.
time_limit=900

usage() {
  echo "usage: test-gpu.sh [--sanitize] [FOLDER]" >&2
  exit 2
}

sanitize=
folder=
for argument in "$@"; do
  case "$argument" in
    --sanitize) sanitize=yes ;;
    -*) usage ;;
    *)
      if [[ -n $folder ]]; then
        usage
      fi
      folder=$argument
      ;;
  esac
done

# programs FOLDER PATTERN: the executables of that name in FOLDER and below, by name.
programs() {
  find "$1" -maxdepth 4 -name CMakeFiles -prune -o -type f -executable -name "$2" -print | sort
}

if [[ -z $folder ]]; then
  folder=$here
  if [[ -z $(programs "$here" 'test_cuda*') ]]; then
    folder=$here/../build/release
  fi
fi
if [[ ! -d $folder ]]; then
  echo "error: there is no folder $folder; build first, with TRISMOOTH_CUDA=ON" >&2
  exit 2
fi
folder=$(cd "$folder" && pwd)

log=$(mktemp)
trap 'rm -f "$log"' EXIT
passed=0
failed=0
skipped=0
summary=()

# run COMMAND...: its exit code in `code`, its output on the terminal and in $log.
run() {
  echo "--- $*"
  code=0
  timeout --kill-after=10 "$time_limit" "$@" 2>&1 | tee "$log" || code=$?
}

# The last line that the program wrote says why it was skipped.
reason() {
  local line
  line=$(grep -v -e '^=========' -e '^[[:space:]]*$' "$log" | tail -n 1 || true)
  echo "${line#skipped: }"
}

# record NAME CODE
record() {
  case "$2" in
    0)
      passed=$((passed + 1))
      summary+=("passed   $1")
      ;;
    "$skip_code")
      skipped=$((skipped + 1))
      summary+=("skipped  $1: $(reason)")
      ;;
    124 | 137)
      failed=$((failed + 1))
      summary+=("failed   $1: stopped, it may have taken longer than $time_limit s")
      ;;
    *)
      failed=$((failed + 1))
      summary+=("failed   $1: exit code $2")
      ;;
  esac
}

finish() {
  echo
  printf '%s\n' "${summary[@]}"
  echo "GPU tests: $passed passed, $failed failed, $skipped skipped"
  if ((failed > 0)); then
    exit 1
  elif ((passed == 0)); then
    exit "$skip_code"
  fi
  exit 0
}

run_tests() {
  local tests
  mapfile -t tests < <(programs "$folder" 'test_cuda*')
  if ((${#tests[@]} == 0)); then
    echo "error: no program test_cuda* in $folder; build with TRISMOOTH_CUDA=ON" >&2
    exit 2
  fi
  for program in "${tests[@]}"; do
    run "$program"
    record "${program##*/}" "$code"
  done
}

# run_planted TOOL: a tool that is blind to its own kind of bug would pass everything.
run_planted() {
  run "$sanitizer" --tool "$1" --error-exitcode 1 "$program" --plant "$1"
  # The program's own failure is not enough: the tool has to have reported something.
  if ((code != 0 && code != skip_code)) && grep -Eq 'SUMMARY: *[1-9]' "$log"; then
    code=0
  elif ((code != skip_code)); then
    code=1
    echo "$1 did not report the bug that was planted for it"
  fi
  record "$1 finds a planted bug" "$code"
}

run_sanitizer() {
  program=$(programs "$folder" test_cuda_sanitizer | head -n 1)
  if [[ -z $program ]]; then
    echo "error: no program test_cuda_sanitizer in $folder" >&2
    exit 2
  fi
  sanitizer=$(command -v compute-sanitizer || command -v /usr/local/cuda/bin/compute-sanitizer || true)
  if [[ -z $sanitizer ]]; then
    echo "error: compute-sanitizer is not installed; it comes with the CUDA Toolkit" >&2
    exit 2
  fi
  # Where there is no device the tools have nothing to say about the program.
  run "$program"
  record "${program##*/} alone" "$code"
  if ((code != 0)); then
    finish
  fi
  for tool in memcheck racecheck initcheck synccheck; do
    run_planted "$tool"
    options=(--tool "$tool" --error-exitcode 1)
    # racecheck (2025.3) ends with an illegal access where kernels of dependent launches overlap. memcheck, which lets
    # them overlap, finds none, nor is there one without the tool. It looks at the shared memory of one kernel at a
    # time, so nothing is lost.
    if [[ $tool == racecheck ]]; then
      options+=(--force-blocking-launches)
    fi
    run "$sanitizer" "${options[@]}" "$program"
    record "$tool" "$code"
  done
}

if [[ -n $sanitize ]]; then
  run_sanitizer
else
  run_tests
fi
finish
