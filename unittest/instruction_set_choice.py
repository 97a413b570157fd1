"""The environment variable APF_ISA chooses among the instruction sets of the processor: the same scene with each, with
none named, and with a name that there is not.

    instruction_set_choice.py LMP
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

lmp = sys.argv[1]
# contacts with all sub-models, liquid bridges, walls and drag: 48 spheres move on a floor
scene = """
boundary p p f
atom_style sphere
atom_modify map array
comm_modify vel yes
region box block 0 8 0 8 0 8 units box
create_box 1 box
lattice sc 1.02 origin 0.5 0.5 0.5
region heap block 1 5 1 5 0 3 units box
create_atoms 1 region heap
set group all diameter 1 density 1
variable s atom sin(7*id)
set group all vx v_s vy v_s vz -1
pair_style granular/adhesive
pair_coeff * * jkr 1.0e6 0.25 50 damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 bridge 0.001 50 0.3 1.0 0.01
fix floor all wall/levelset plane z 0 NULL jkr 1.0e6 0.25 50 damping tsuji 0.5 sliding 0.3
fix air all flow/field shear x z 5 0 density 0.01 viscosity 0.1
fix drag all flow/force air drag stokes torque yes gravity 0 0 -500
fix move all nve/sphere
timestep 6.0e-5
dump end all custom 1000 DUMP id x y z vx vy vz fx fy fz
dump_modify end sort id format float %.17g
run 1000
"""


def run(wanted):
    """Numbers of all spheres at the end, each quantity a list, and what stands in the errors' stream."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "in.scene"
        path.write_text(scene.replace("DUMP", folder + "/dump"))
        environment = {name: value for name, value in os.environ.items() if name != "APF_ISA"}
        if wanted:
            environment["APF_ISA"] = wanted
        done = subprocess.run([lmp, "-in", path, "-log", "none"], cwd=folder, capture_output=True, text=True,
                              env=environment)
        if done.returncode != 0:
            sys.exit(f"APF_ISA={wanted} ends with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr}")
        last = (Path(folder) / "dump").read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]
    rows = [[float(word) for word in line.split()[1:]] for line in last]
    return [[row[column] for row in rows] for column in range(9)], done.stderr


def apart(a, b):
    """Largest difference of a quantity, of its largest value."""
    return max(max(abs(x - y) for x, y in zip(u, v)) / max(map(abs, v)) for u, v in zip(a, b))


def expect(true, what):
    if not true:
        sys.exit(f"ERROR: {what}")
    print(what)


flags = set()
for line in Path("/proc/cpuinfo").read_text().splitlines():
    if line.startswith("flags"):
        flags = set(line.split())
        break
sets = ["baseline"]
if {"avx2", "fma"} <= flags:
    sets.append("avx2")
    if {"avx512f", "avx512dq", "avx512vl"} <= flags:
        sets.append("avx512")

ends = {}
for name in sets:
    ends[name], errors = run(name)
    expect("APF_ISA" not in errors, f"{name} is taken")
    expect(len(ends[name][0]) == 48, f"{name}: all spheres are there")
    if name != "baseline":    # which has no fused products
        difference = apart(ends[name], ends["baseline"])
        expect(0.0 < difference < 1e-10, f"{name} differs from baseline by rounding: {difference:.3g}")
best, errors = run(None)
expect("APF_ISA" not in errors and best == ends[sets[-1]], f"none named: {sets[-1]}, to the last digit")
for wrong in ("pentium", "AVX2"):
    same, errors = run(wrong)
    message = f"APF: environment variable APF_ISA={wrong} names no instruction set of this processor and build; " \
              f"taking {sets[-1]} of {' '.join(sets)}\n"
    expect(errors.count(message) == 1, f"APF_ISA={wrong}: one warning")
    expect(same == best, f"APF_ISA={wrong}: the same as without")
