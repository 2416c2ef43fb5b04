#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes of this folder from the geometries beside them. Needs Gmsh (4.8 made the files that are here; other
# versions give other triangles) and Python 3.
set -eu
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# make NAME EXTENSION TITLE [option of convert.py]...
make() {
  name=$1
  extension=$2
  title=$3
  shift 3
  gmsh -2 -nt 1 -v 2 -format msh22 -o "$work/$name.msh" "$name.geo"
  ./convert.py "$work/$name.msh" "$name.$extension" --title "$title" "$@"
}

make plate off "Wall bracket of steel plate, millimetres" --jitter 0.45 --decimals 6
make machine vtu "One pole of a permanent-magnet machine, millimetres" --jitter 0.4 --decimals 8 --encoding base64
make farfield vtk "Aerofoil with slotted flap, far field at 40 chords" --jitter 0.4 --decimals 8
make coast vtu "Coast with islands, metres" --jitter 0.45 --decimals 3 --encoding zlib --depth
