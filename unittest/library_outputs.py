"""Every output of every style, through LAMMPS's Python module: global scalars, vectors and arrays, per-atom, local
and per-grid data. Two spheres in contact, one of them on the floor, in a slow shear flow.

Exit code 77: skipped, because the module cannot be had here.
"""
import math
import os
import sys
import tempfile

try:
    from lammps import (LMP_SIZE_COLS, LMP_SIZE_ROWS, LMP_SIZE_VECTOR, LMP_STYLE_ATOM, LMP_STYLE_GLOBAL,
                        LMP_STYLE_LOCAL, LMP_TYPE_ARRAY, LMP_TYPE_SCALAR, LMP_TYPE_VECTOR, lammps)
except ImportError as missing:
    print("skipped: Python has no module lammps:", missing)
    sys.exit(77)

GAP, RATE, VISCOSITY, DENSITY = 1.0e-3, 0.1, 2.0, 0.5
LOWER, UPPER = (4.0, 4.0, 0.5 - GAP), (4.0, 4.0, 1.5 - 2 * GAP)
VOLUME = math.pi / 6
failed = []


def check(what, value, expected, tolerance=1.0e-9):
    """Notes a value that is not what it must be; relative to 1 or to the value, whichever is larger."""
    inside = abs(value - expected) <= tolerance * max(1.0, abs(expected))
    print(f"{what:55} {value:20.12g} {expected:20.12g}{'' if inside else '   WRONG'}")
    if not inside:
        failed.append(what)


lmp = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
lmp.commands_string(f"""
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p f
region box block 0 8 0 8 0 8
create_box 1 box
create_atoms 1 single {LOWER[0]} {LOWER[1]} {LOWER[2]:.17g}
create_atoms 1 single {UPPER[0]} {UPPER[1]} {UPPER[2]:.17g}
set group all diameter 1 density 1
pair_style granular/adhesive
pair_coeff 1 1 jkr 1.0e6 0.25 100 damping alpha 1 sliding 0.3 twisting yes rolling 0.01
fix floor all wall/levelset plane z 0 NULL jkr 1.0e6 0.25 100
fix shear all flow/field shear x z {RATE} 0 density {DENSITY} viscosity {VISCOSITY}
fix cloud all flow/concentration 8 8 8 cloud 1 every 1
fix drag all flow/force shear drag stokes torque yes concentration cloud feedback yes
fix in all inlet/flow x 1 shear number 1 every 5 diameter 0.2 density 1 type 1 seed 7
fix move all nve/sphere/mts collision 4
compute aggregates all aggregate/contact
compute deposit all wall/deposit floor
compute parts all pair/local dist eng force p1 p2 p3
compute energy all pair granular/adhesive
fix mean all ave/grid 1 1 1 8 8 8 f_cloud:grid:data f_drag:grid:data[1] f_drag:grid:data[2] f_drag:grid:data[3]
timestep 1.0e-6
thermo_style custom step f_floor f_floor[1] f_floor[1][1] f_shear[1] f_cloud[1] f_drag[1] f_in[1] f_move[1] &
  c_aggregates[1] c_deposit[1] c_energy[1] pe
thermo_modify norm no
""")
folder = tempfile.mkdtemp()
grid_file = os.path.join(folder, "grid")
lmp.commands_string(f"""
dump local all local 1 {folder}/local c_parts[*]
dump grid all grid 1 {grid_file} f_mean:grid:data[*]
run 0
""")
f = lmp.gather_atoms("f", 1, 3)    # by atom ID


def vector_of(style, name, length, extract):
    """Global vector of a fix or a compute, whose length is checked."""
    size = extract(name, LMP_STYLE_GLOBAL, LMP_SIZE_VECTOR)
    check(f"{style}: length of its vector", size, length, 0)
    if extract == lmp.extract_compute:
        values = extract(name, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR)
        return [values[n] for n in range(length)]
    return [extract(name, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, nrow=n) for n in range(length)]


# ---- fix flow/field
vector = vector_of("flow/field", "shear", 9, lmp.extract_fix)
for n, expected in ((0, RATE), (3, DENSITY), (4, VISCOSITY), (6, 0.0)):
    check(f"flow/field [{n + 1}]", vector[n], expected)

# ---- fix flow/force: Stokes drag on spheres at rest, torque 1/2 pi mu d^3 curl u
drag = lmp.extract_fix("drag", LMP_STYLE_ATOM, LMP_TYPE_ARRAY)
check("flow/force: columns per atom", lmp.extract_fix("drag", LMP_STYLE_ATOM, LMP_SIZE_COLS), 6, 0)
total = 0.0
ids = lmp.extract_atom("id")
for i in range(2):
    u = RATE * (LOWER, UPPER)[ids[i] - 1][2]
    check(f"flow/force: drag over Stokes's, atom {ids[i]}", drag[i][0] / (3 * math.pi * VISCOSITY * u), 1.0, 1.0e-4)
    check(f"flow/force: torque, atom {ids[i]}", drag[i][4] / (0.5 * math.pi * VISCOSITY * RATE), 1.0, 1.0e-4)
    total += drag[i][0]
vector = vector_of("flow/force", "drag", 27, lmp.extract_fix)
check("flow/force [1], sum of drag", vector[0], total)
check("flow/force [22], sum of all", vector[21], total)
check("flow/force [25], on the grid", vector[24], -total)

# ---- fix flow/concentration
vector = vector_of("flow/concentration", "cloud", 3, lmp.extract_fix)
check("flow/concentration [1], volume of particles", vector[0], 2 * VOLUME, 1.0e-6)
check("flow/concentration [3], cells above 0.64", vector[2], 0, 0)

# ---- per-grid data, as dump grid and fix ave/grid read them
with open(grid_file) as lines:
    text = lines.read().splitlines()
start = next(n for n, line in enumerate(text) if line.startswith("ITEM: GRID CELLS")) + 1
cells = [[float(word) for word in line.split()] for line in text[start:]]
check("grid: cells", len(cells), 512, 0)
check("grid: volume of particles", sum(row[0] for row in cells), 2 * VOLUME, 1.0e-4)
check("grid: largest concentration", max(row[0] for row in cells), vector[1], 1.0e-4)
check("grid: force", sum(row[1] for row in cells), -total, 1.0e-4)
check("grid: force across", sum(abs(row[2]) for row in cells), 0.0)

# ---- fix wall/levelset
vector = vector_of("wall/levelset", "floor", 19, lmp.extract_fix)
# the pair's force cancels; drag within the step takes a share step/(2 tau) = 1e-5 from every force
check("wall/levelset [3], against the force on the spheres", vector[2], -(f[2] + f[5]), 2.0e-5)
check("wall/levelset [7], contacts", vector[6], 1, 0)
energy = lmp.extract_fix("floor", LMP_STYLE_GLOBAL, LMP_TYPE_SCALAR)
rows = lmp.extract_fix("floor", LMP_STYLE_GLOBAL, LMP_SIZE_ROWS)
columns = lmp.extract_fix("floor", LMP_STYLE_GLOBAL, LMP_SIZE_COLS)
check("wall/levelset: columns", columns, 16, 0)
whole = [lmp.extract_fix("floor", LMP_STYLE_GLOBAL, LMP_TYPE_ARRAY, nrow=rows - 1, ncol=n) for n in range(columns)]
check("wall/levelset, whole wall: force", whole[2], vector[2])
check("wall/levelset, whole wall: deposited", whole[8], 2, 0)
check("wall/levelset, whole wall: their mass", whole[11], 2 * VOLUME)
check("wall/levelset, whole wall: area", whole[12], 64.0)
check("wall/levelset, whole wall: mass per area", whole[13], 2 * VOLUME / 64)

# ---- compute wall/deposit
heights = lmp.extract_compute("deposit", LMP_STYLE_ATOM, LMP_TYPE_VECTOR)
vector = vector_of("wall/deposit", "deposit", 3, lmp.extract_compute)
check("wall/deposit [1], particles", vector[0], 2, 0)
check("wall/deposit: largest height per atom", max(heights[0], heights[1]), vector[1])
array = lmp.extract_compute("deposit", LMP_STYLE_GLOBAL, LMP_TYPE_ARRAY)
check("wall/deposit: array, whole wall", array[rows - 1][0], 2, 0)

# ---- compute aggregate/contact
vector = vector_of("aggregate/contact", "aggregates", 6, lmp.extract_compute)
for n, expected in enumerate((2, 1, 2, 2, 1, 2)):
    check(f"aggregate/contact [{n + 1}]", vector[n], expected, 0)
array = lmp.extract_compute("aggregates", LMP_STYLE_ATOM, LMP_TYPE_ARRAY)
for i in range(2):
    check("aggregate/contact: size, on a wall", 10 * array[i][1] + array[i][2], 21, 0)
    check("aggregate/contact: contacts", array[i][3], 2 if ids[i] == 1 else 1, 0)

# ---- pair_style: local data and energies
check("pair/local: contacts", lmp.extract_compute("parts", LMP_STYLE_LOCAL, LMP_SIZE_ROWS), 1, 0)
local = lmp.extract_compute("parts", LMP_STYLE_LOCAL, LMP_TYPE_ARRAY)
check("pair/local: distance", local[0][0], 1 - GAP)
check("pair/local: overlap", local[0][3], GAP, 1.0e-12)
check("pair/local: force on sphere 2", local[0][2], f[5], 2.0e-5)
check("pair/local: elastic force is all of it at rest", local[0][5], local[0][2])
R, E = 0.25, 0.5e6 / (1 - 0.25**2)
a0 = (9 * math.pi * 100 * R * R / E) ** (1 / 3)
h = local[0][4] / a0
check("pair/local: overlap from the contact radius", a0**2 / (2 * R) * (2 * h**2 - 4 / 3 * math.sqrt(h)), GAP, 1.0e-12)
energies = vector_of("pair", "energy", 5, lmp.extract_compute)
check("pair: energies add up to that of pair/local", sum(energies), local[0][1])
check("pair: potential energy", lmp.get_thermo("pe"), sum(energies))

# ---- integrator and inlet
lmp.command("run 3")
vector = vector_of("nve/sphere/mts", "move", 6, lmp.extract_fix)
for n, expected in ((0, 4), (1, 2 / lmp.get_natoms()), (2, 2), (3, 12), (4, 0)):
    check(f"nve/sphere/mts [{n + 1}]", vector[n], expected)
lmp.command("run 9")
vector = vector_of("inlet/flow", "in", 10, lmp.extract_fix)
entered = vector[0]
check("inlet/flow [1], entered", entered, 2, 0)
check("inlet/flow: atoms", lmp.get_natoms(), 4, 0)
check("inlet/flow [4], their volume", vector[3], entered * math.pi / 6 * 0.2**3)
check("inlet/flow [3], their mass", vector[2], vector[3])

lmp.close()
if failed:
    sys.exit("wrong: " + "; ".join(failed))
print("library outputs: pass")
