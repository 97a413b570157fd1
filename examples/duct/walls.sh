#!/usr/bin/env bash
# Walls of the duct as distances on a grid: duct.vtkhdf, here already, and duct.vtp for ParaView.
cd "$(dirname "${BASH_SOURCE[0]}")" || exit
# floor with a step, bar with four edges, ceiling; all is the same along z, where nodes may be far apart
../../flowgrid duct.vtkhdf --spacing 2e-6 2e-6 8e-5 --bounds 0 4.8e-4 0 2.4e-4 0 1.6e-4 --compress \
  --shape "floor: extrude(-1,1, polygon(-1e-3,-1e-3, 1.5e-3,-1e-3, 1.5e-3,8e-5, 3.4e-4,8e-5, 3.4e-4,2e-5, -1e-3,2e-5))" \
  --shape "bar: extrude(-1,1, polygon(1.0e-4,1.2e-4, 1.6e-4,1.0e-4, 1.8e-4,1.2e-4, 1.4e-4,1.6e-4))" \
  --shape "ceiling: plane(0,2.3e-4,0, 0,-1,0)" --particle 2e-5 --band 4 --isosurface duct.vtp
