#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests under Clang's sanitizers, the fuzz targets for a moment, says how much of the code the tests reach, and
# has clang-tidy look at what changed:
#
#   scripts/sanitize.sh            all of it
#   scripts/sanitize.sh tidy       clang-tidy alone: scripts/tidy.sh --changed
#   scripts/sanitize.sh asan       address and undefined behaviour: tests, coverage, a short run of every fuzz target
#   scripts/sanitize.sh tsan       threads: the tests of what runs on several
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# Of one processor, for all targets together. scripts/fuzz.sh is for longer runs.
fuzz_seconds=120
python_fuzz_seconds=20
# Of the lines of these folders the tests must reach so many.
covered_folders=(base quality smoothing mesh_io)
least_coverage=90
# Runs in a child process alone, which may open no file and so leaves no profile.
not_counted=mesh_io/hdf5/hdf5_service.cpp

export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1}
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$project/tests/leaks_of_libraries.txt:print_suppressions=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
# Under a sanitizer everything takes several times as long: random tests make so
# many per cent of their meshes.
export TRISMOOTH_MESHES=${TRISMOOTH_MESHES:-5}

# build PRESET TARGET...
build() {
  local preset=$1
  shift
  # shellcheck disable=SC2046 # several options
  (cd "$project" && cmake --preset "$preset" $(python_options) >/dev/null && cmake --build --preset "$preset" --target "$@")
  echo "$preset: built after $SECONDS s"
}

# run PRESET TEST...: runs the test programs, as many at a time as there are processors.
run() {
  local preset=$1
  shift
  # shellcheck disable=SC2016 # the inner shell expands
  printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c '
    log=$0/$1.log
    if LLVM_PROFILE_FILE=$0/$1.profraw "$0/tests/$1" >"$log" 2>&1; then
      echo "$1: $(grep -a -E "^All tests passed" "$log")"
    else
      cat "$log"
      echo "error: $1 failed" >&2
      exit 255
    fi' "$project/build/$preset"
  echo "$preset: run after $SECONDS s"
}

# print_coverage TEST...: lines reached by the programs that were just run with preset asan. Sources are known by their
# own folder, headers by the link to it through which they are included.
print_coverage() {
  local build=$project/build/asan programs=() profiles=() folder
  for program in "$@"; do
    profiles+=("$build/$program.profraw")
    programs+=(-object "$build/tests/$program")
  done
  llvm-profdata merge -sparse -o "$build/tests.profdata" "${profiles[@]}"
  local status=0
  for folder in "${covered_folders[@]}"; do
    # The last line is the sum; its columns: regions, missed, share, functions, missed, share, lines, missed, share.
    local share
    share=$(llvm-cov report "${programs[@]:1}" -instr-profile="$build/tests.profdata" -ignore-filename-regex="$not_counted" \
      "$project/$folder" "$build/include/trismooth/$folder" 2>/dev/null |
      awk '$1 == "TOTAL" { sub("%", "", $10); print $10 }')
    echo "coverage: $share % of the lines of $folder/"
    if ! awk -v share="$share" -v least="$least_coverage" 'BEGIN { exit !(share >= least) }'; then
      echo "error: that is less than $least_coverage %" >&2
      status=1
    fi
  done
  return "$status"
}

run_asan() {
  # The longest first.
  local tests=(test_properties test_mesh_io test_bad_input test_base test_smoothing test_quality test_halfedge test_fuzz_regressions)
  export TRISMOOTH_FUZZ_REGRESSIONS=$project/tests/fuzz/regressions
  local python_module=()
  if [[ $(python_options) == *=ON* ]]; then
    python_module=(trismooth_python)
  fi
  build asan "${tests[@]}" fuzz fuzz_seeds "${python_module[@]}"
  run asan "${tests[@]}"
  run_in_pieces
  print_coverage "${tests[@]}"
  "$project/scripts/fuzz.sh" --no-build --seconds-of-all "$fuzz_seconds"
  echo "asan: fuzzed after $SECONDS s"
  if ((${#python_module[@]} > 0)); then
    fuzz_python
  fi
}

# On ranks. What MPI itself never gives back is left out.
run_in_pieces() {
  build asan test_mpi
  local of_mpi
  mapfile -t of_mpi < <(grep '^OMPI' "$project/tests/mpi/environment")
  env "${of_mpi[@]}" "LLVM_PROFILE_FILE=$project/build/asan/test_mpi_%p.profraw" \
    "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0" mpirun -n 3 "$project/build/asan/tests/mpi/test_mpi"
  rm -f "$project/build/asan/"test_mpi_*.profraw
  echo "asan: run on ranks after $SECONDS s"
}

# Calls from Python with arrays right and wrong, for a moment. Of Python's own memory nothing is said.
fuzz_python() {
  local runtime
  runtime=$(clang -print-file-name="libclang_rt.asan-$(uname -m).so")
  LLVM_PROFILE_FILE=/dev/null ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 PYTHONMALLOC=malloc \
    LD_PRELOAD=$runtime PYTHONPATH=$project/build/asan/python \
    "$python_environment/bin/python" -B "$project/python/fuzz/fuzz_arrays.py" --seconds "$python_fuzz_seconds"
  echo "asan: fuzzed from Python after $SECONDS s"
}

run_tsan() {
  local tests=(test_smoothing test_base test_quality)
  build tsan "${tests[@]}"
  run tsan "${tests[@]}"
}

"$project/scripts/install-deps.sh" --tools
keep_temporary_files_in_memory
case "${1:-all}" in
  all)
    "$project/scripts/tidy.sh" --changed
    run_asan
    run_tsan
    ;;
  tidy) exec "$project/scripts/tidy.sh" --changed ;;
  asan) run_asan ;;
  tsan) run_tsan ;;
  *)
    sed -n '2,8s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
