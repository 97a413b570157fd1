#!/usr/bin/env bash
# Air past a support bar between two fins with OpenFOAM, on a Cartesian grid:   flow.sh [CELLS [FOLDER]]
# makes radiator.vtkhdf. CELLS (16) lie on a quarter of the bar. With CELLS = table it prints the drag on the bar for
# 8, 16 and 24 instead.
source "$(dirname "${BASH_SOURCE[0]}")/../openfoam.sh"
cells=${1:-16} out=${2:-$here}

section() { # with $1 cells on a quarter of the bar
  solve around=$1 across=$1 along=$1 high=$(($1 * 3 / 4))
}
if [ "$cells" = table ]; then
  for n in 8 16 24; do
    section $n >/dev/null
    awk "BEGIN { printf \"%3d cells: drag on the bar / (rho U^2 / 2 of 1 mm x 1 mm) = %.4f\n\", $n, $(drag) / 0.6 / 1.667^2 / 1e-6 }"
  done
  exit
fi
section "$cells"
map "$out/radiator.vtkhdf" --spacing 1e-4 --compress --bounds -3e-3 6e-3 -1.5e-3 1.5e-3 -5e-4 5e-4 \
  --shape "bar: disc(0,0, 5e-4)" --shape "below: plane(0,0,-5e-4, 0,0,1)" --shape "above: plane(0,0,5e-4, 0,0,-1)"
