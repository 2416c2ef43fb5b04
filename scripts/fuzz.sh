#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes the readers and the interface of flat arrays with libFuzzer (Clang, preset asan).
#
#   scripts/fuzz.sh [--seconds N | --seconds-of-all N] [--no-build] [TARGET...]
#
# Runs each target for N seconds (default 600), or all of them for N seconds of one processor; as many at a time as there
# are processors. Targets are the formats, by the names that --format takes, and flat_arrays; without arguments all.
# What has been found worth keeping stays in build/fuzz/TARGET/corpus, where the next run goes on from. Exit status 1
# where an input was found that breaks a promise.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=600
seconds_of_all=
builds=true
targets=()
while (($# > 0)); do
  case $1 in
    --seconds)
      seconds=${2:?--seconds needs a number}
      shift
      ;;
    --seconds-of-all)
      seconds_of_all=${2:?--seconds-of-all needs a number}
      shift
      ;;
    --no-build) builds=false ;;
    -*)
      sed -n '2,10s/^# \{0,1\}//p' "$0" >&2
      exit 2
      ;;
    *) targets+=("$1") ;;
  esac
  shift
done
build=$project/build/asan
programs=$build/tests/fuzz
data=$project/tests/fuzz
work=$project/build/fuzz
# Every process with the sanitizers' coverage writes a profile when it ends; of fuzzing it says nothing.
export LLVM_PROFILE_FILE=/dev/null
# VTK keeps no frame pointers: longer stacks of allocations are wrong and all differ, which fills the memory.
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$project/tests/leaks_of_libraries.txt:print_suppressions=0}
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}

if $builds; then
  (cd "$project" && cmake --preset asan >/dev/null)
  cmake --build "$build" --target fuzz fuzz_seeds
fi
mapfile -t all_targets < <("$programs/fuzz_seeds" "$work/seeds")
if ((${#targets[@]} == 0)); then
  targets=("${all_targets[@]}")
fi
if [[ -n $seconds_of_all ]]; then
  seconds=$((seconds_of_all / ${#targets[@]}))
fi

fuzz() {
  local target=$1 dictionary folders=()
  case $target in
    vtu | vtp) dictionary=vtk_xml ;;
    *) dictionary=$target ;;
  esac
  mkdir -p "$work/$target/corpus" "$work/$target/finds"
  folders=("$work/$target/corpus" "$work/seeds/$target")
  if [[ -d $data/regressions/$target ]]; then
    folders+=("$data/regressions/$target")
  fi
  local options=(-max_total_time="$seconds" -max_len=32768 -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=512
    -artifact_prefix="$work/$target/finds/" -print_final_stats=1)
  if [[ -f $data/dictionaries/$dictionary.dict ]]; then
    options+=(-dict="$data/dictionaries/$dictionary.dict")
  fi
  "$programs/fuzz" "--target=$target" "${options[@]}" "${folders[@]}" >"$work/$target/log" 2>&1 || touch "$work/$target/failed"
}

# The last value behind a label of libFuzzer's log.
last() {
  grep -a -o -E "$1 *[0-9]+" "$work/$target/log" | grep -o -E '[0-9]+$' | tail -1 || true
}

running=0
for target in "${targets[@]}"; do
  rm -f "$work/$target/failed"
  if ((running == $(nproc))); then
    wait -n
    running=$((running - 1))
  fi
  fuzz "$target" &
  running=$((running + 1))
done
wait

status=0
printf '%-12s %11s %8s %8s %8s %7s  %s\n' target executions exec/s edges of corpus result
for target in "${targets[@]}"; do
  edges=$(grep -a -o -E '\([0-9]+ inline' "$work/$target/log" | tr -dc '0-9\n' | tail -1 || true)
  result=nothing
  if [[ -e $work/$target/failed ]]; then
    result=FOUND
    status=1
  fi
  printf '%-12s %11s %8s %8s %8s %7s  %s\n' "$target" "$(last 'number_of_executed_units:')" \
    "$(last 'average_exec_per_sec:')" "$(last 'cov:')" "$edges" "$(last 'corp:')" "$result"
done
for target in "${targets[@]}"; do
  if [[ -e $work/$target/failed ]]; then
    echo
    echo "$target: $(grep -a -m 1 -E 'what\(\)|ERROR: |runtime error: ' "$work/$target/log" || tail -1 "$work/$target/log")"
    find=$(grep -a -o 'Test unit written to .*' "$work/$target/log" | tail -1 || true)
    if [[ -n $find ]]; then
      find=${find#Test unit written to }
      echo "  log:          $work/$target/log"
      echo "  to see again: $programs/fuzz --target=$target $find"
      echo "  to keep:      cp $find $data/regressions/$target/what_it_broke"
    fi
  fi
done
exit "$status"
