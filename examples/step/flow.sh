#!/usr/bin/env bash
# Computes the air behind the step with OpenFOAM and maps it on a Cartesian grid: step.vtkhdf.
# Needs Debian's package openfoam. Half a minute.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-$here}
case=$(mktemp -d)
trap 'rm -rf "$case"' EXIT
cp -r "$here"/case/. "$case"
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} # Debian's scripts look there
(cd "$case" && blockMesh >log.blockMesh && simpleFoam >log.simpleFoam) ||
  { tail -n 20 "$case"/log.*; exit 1; }
grep 'solution converged' "$case/log.simpleFoam"
"$here/../../flowgrid" "$case" "$out/step.vtkhdf" --spacing 2e-5 --planar 5e-5 --compress
