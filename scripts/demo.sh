#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the program and smooths an example mesh: one pole of an electric machine with ten material regions.
# Fails where the mesh did not get better.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$project/scripts/install-deps.sh"
# For one machine: the part that runs over the ranks of an MPI job is left out.
configure "$(cuda_option)" -DTRISMOOTH_MPI=OFF -UTRISMOOTH_METIS
build_target trismooth_program

cd "$project"
mkdir -p out
echo
build/release/pipeline/trismooth smooth examples/data/machine.vtu out/machine.vtu --annotate \
  --report out/machine.json --report out/machine.html \
  --require 'min_shape>=0.5' --require 'mean_shape>=0.95' --require 'inverted==0'
echo
python3 - out/machine.json <<'PYTHON'
import json
import sys

with open(sys.argv[1]) as file:
    report = json.load(file)
before, after = (report[key]["metrics"]["shape"] for key in ("before", "after"))
if not (after["min"] > before["min"] and after["mean"] > before["mean"]):
    sys.exit("The mesh did not get better.")
print("The mesh got better. Shape is 1 for an equilateral triangle and 0 for a flat one:")
print(f"  smallest shape  {before['min']:.3f} -> {after['min']:.3f}")
print(f"  mean shape      {before['mean']:.3f} -> {after['mean']:.3f}")
PYTHON
echo
echo "Smoothed mesh:  $project/out/machine.vtu   (open it in ParaView and colour it by 'trismooth:shape')"
echo "Report:         $project/out/machine.html  (open it in a browser)"
