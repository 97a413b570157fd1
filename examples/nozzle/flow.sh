#!/usr/bin/env bash
# Water in a nozzle with OpenFOAM, on a Cartesian grid with its walls:  flow.sh LENGTH [CELLS [FOLDER [small]]]
# makes nozzle-LENGTH.vtkhdf, LENGTH = 0, 0.5 or 1 the length of the contraction in channel widths.
# CELLS (40) lie across the exit. With CELLS = table it prints the loss of pressure for 20, 40 and 80.
# small: only walls, for particles of 2 um that enter one width before the contraction, nozzle-LENGTH-ratio50-walls.vtkhdf.
source "$(dirname "${BASH_SOURCE[0]}")/../openfoam.sh"
length=${1:-0.5} cells=${2:-40} out=${3:-$here} small=${4:-}
end=$(awk "BEGIN { print $length + 2 }")
[ "$length" = 0 ] && blocks=step || blocks=taper

nozzle() { # with $1 cells across
  solve c="$length" end="$end" across="$1" before=$((3 * $1)) within=$(($1 * 3 / 2)) behind=$((2 * $1)) \
    layer=$(($1 * 3 / 4)) core=$(($1 * 3 / 4)) blocks=$blocks
}
if [ "$cells" = table ]; then
  for n in 20 40 80; do
    nozzle $n >/dev/null
    printf 'length %s, %3d cells: loss of pressure / (rho U^2) = ' "$length" $n
    grep -v '#' "$case"/postProcessing/entry/*/*.dat | tail -n 1 | awk '{ print $2 }'
  done
  exit
fi
# a channel of width 1 from -20, the contraction from 0 to LENGTH, the exit of width 0.2, in half millimeters
corners() { # of the solid above (1) or below (-1); faces that lie in one plane would be taken for one
  awk -v s="$1" -v c="$length" 'BEGIN {
    x = c == 0 && s < 0 ? 1e-6 : 0
    n = split("-20 0.5 " x " 0.5 " c + x " 0.1 20 0.1 20 2 -20 2", v, " ")
    for (k = 1; k <= n; k++) printf "%s%.10g", (k > 1 ? ", " : ""), v[k] * (k % 2 ? 1 : s) * 5e-4 }'
}
solids=(--crease 15 --shape "above: polygon($(corners 1))" --shape "below: polygon($(corners -1))")
bounds() { echo --bounds "$1" "$(awk "BEGIN { print $end * 5e-4 }")" -2.55e-4 2.55e-4 0 0; }
if [ -n "$small" ]; then
  walls "$out/nozzle-$length-ratio50-walls.vtkhdf" --spacing 3.3e-7 --planar 0 --band 8 --particle 2e-6 --compress \
    $(bounds -5.2e-4) "${solids[@]}"
  exit
fi
nozzle "$cells"
map "$out/nozzle-$length.vtkhdf" --planar 2.5e-4 --spacing 5e-6 --compress $(bounds -2.5e-3) "${solids[@]}"
walls "$out/nozzle-$length-walls.vtkhdf" --spacing 7e-7 --planar 0 --band 8 --particle 1e-5 --compress $(bounds -2.5e-3) "${solids[@]}"
