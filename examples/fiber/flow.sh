#!/usr/bin/env bash
# Air past a row of fibers with OpenFOAM, on a Cartesian grid:   flow.sh W [CELLS [FOLDER [SPACING]]]
# makes fiber-wW.vtkhdf for fibers at a distance of W radii. CELLS (48) lie on a quarter of the fiber.
# SPACING (5e-7 m) is that of the grid; 1.25e-7 for full runs. With CELLS = table it prints the drag on the fiber for
# 24, 48 and 96 instead.
source "$(dirname "${BASH_SOURCE[0]}")/../openfoam.sh"
W=${1:-8} cells=${2:-48} out=${3:-$here} spacing=${4:-5e-7}
half=$(awk "BEGIN { print $W / 2 }")

row() { # of fibers, with $1 cells on a quarter of each
  solve h=$half m=-$half around=$1 across=$1 along=$(($1 * 5 / 6)) end=$((3 * W)) start=$((-3 * W))
}
if [ "$cells" = table ]; then
  for n in 24 48 96; do
    row $n >/dev/null
    awk "BEGIN { printf \"W %g, %3d cells: drag / (mu U) of a length = %.4f\n\", $W, $n, $(drag) / 2e-5 / 1.79e-5 / 0.26 }"
  done
  exit
fi
row "$cells"
map "$out/fiber-w$W.vtkhdf" --spacing "$spacing" "$spacing" 2e-5 --compress --shape "fiber: disc(0,0, 1e-5)" \
  --bounds -4e-5 4e-5 -${half}e-5 ${half}e-5 -1e-5 1e-5
