# Sourced by flow.sh of the examples: an OpenFOAM case from its dictionaries to its last time.
# Needs Debian's package openfoam.
set -euo pipefail
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} # Debian's scripts look there
here=$(cd "$(dirname "${BASH_SOURCE[1]}")" && pwd)
case=$(mktemp -d)
trap 'rm -rf "$case"' EXIT

# solve NAME=VALUE...: copies the folder `case`, sets the names in its system/mesh, and runs it in $case
solve() {
  rm -rf "${case:?}"/*
  cp -r "$here"/case/. "$case"
  for word in "$@"; do
    grep -q "\b${word%%=*} [^;]*;" "$case/system/mesh" || { echo "no ${word%%=*} in system/mesh" >&2; exit 1; }
    sed -i "s|\b${word%%=*} [^;]*;|${word%%=*} ${word#*=};|" "$case/system/mesh"
  done
  (cd "$case" && blockMesh >log.blockMesh &&
    if [ -e system/mirrorMeshDict ]; then mirrorMesh -overwrite >log.mirrorMesh; fi &&
    simpleFoam >log.simpleFoam) ||
    { tail -n 20 "$case"/log.* >&2; exit 1; }
  grep 'solution converged' "$case/log.simpleFoam" || { echo "simpleFoam has not converged" >&2; exit 1; }
}

# drag along x of the function object `drag`, at the end
drag() { grep 'Total *:' "$case/log.simpleFoam" | tail -n 2 | head -n 1 | sed 's/.*: (\([^ ]*\) .*/\1/'; }

# the flow in $case, or walls alone, on a Cartesian grid. FLOWGRID: another build of it
flowgrid=${FLOWGRID:-$here/../../flowgrid}
map() { "$flowgrid" "$case" "$@"; }
walls() { "$flowgrid" "$@"; }
