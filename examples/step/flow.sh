#!/usr/bin/env bash
# Computes the air behind the step with OpenFOAM and maps it on a Cartesian grid: step.vtkhdf, here or in
# the folder that is named. Needs Debian's package openfoam. Half a minute.
source "$(dirname "${BASH_SOURCE[0]}")/../openfoam.sh"
solve
map "${1:-$here}/step.vtkhdf" --spacing 2e-5 --planar 5e-5 --compress
