#!/usr/bin/env bash
# Air in the entry of a radiator with OpenFOAM, on a Cartesian grid, and its walls:   flow.sh [CELLS [FOLDER]]
# makes radiator.vtkhdf and radiator-walls.vtkhdf. CELLS (12) lie between a fin and the middle of a channel. With
# CELLS = table it prints the loss of pressure for 8, 12 and 16 instead.
source "$(dirname "${BASH_SOURCE[0]}")/../openfoam.sh"
cells=${1:-12} out=${2:-$here}

section() { # with $1 cells between a fin and the middle of a channel
  solve front=$(($1 * 7 / 6)) corner=$(($1 * 2 / 3)) out=$(($1 * 5 / 3)) around=$(($1 * 2)) nose=$(($1 / 2)) gap="$1" \
    before=$(($1 * 4 / 3)) along=$(($1 * 8 / 3))
}
if [ "$cells" = table ]; then
  for n in 8 12 16; do
    section $n >/dev/null
    printf '%3d cells: loss of pressure / (rho U^2) = ' $n
    grep -v '#' "$case"/postProcessing/entry/*/*.dat | tail -n 1 | awk '{ printf "%.4f\n", $2 / 1.667^2 }'
  done
  exit
fi
section "$cells"
bounds=(--compress --bounds -1.2e-3 2.4e-3 -1.5e-3 1.5e-3 -6e-4 6e-4)
edge=5e-4 far=9e-3                # half the bar's width, and a place outside
bar="union(rectangle(2e-4,-$edge, $far,$edge), rectangle(0,-3e-4, $far,3e-4), disc(2e-4,-3e-4, 2e-4), disc(2e-4,3e-4, 2e-4))"
fin="union(box(6e-4,-$far,-1e-4, $far,$far,1e-4), cylinder(6e-4,-$far,0, 6e-4,$far,0, 1e-4))"
solids=(--shape "bar: $bar" --shape "fins: $fin")
map "$out/radiator.vtkhdf" --spacing 6e-5 --band 4 "${bounds[@]}" "${solids[@]}"
walls "$out/radiator-walls.vtkhdf" --spacing 2e-5 --band 6 --particle 2e-5 "${bounds[@]}" "${solids[@]}"
