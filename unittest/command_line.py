"""LAMMPS's info command knows the styles, and -skiprun skips runs. (lmp -h ends before LAMMPS loads plugins, so that
only built-in styles are in its list: tools/test_drop_in looks there.)

    command_line.py LMP
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

STYLES = {
    "pair": ["granular/adhesive"],
    "fix": ["wall/levelset", "flow/field", "flow/force", "flow/concentration", "inlet/flow", "nve/sphere/mts",
            "contact/history"],
    "compute": ["aggregate/contact", "wall/deposit"],
    "command": ["apf_advise"],
}
lmp = sys.argv[1]


def said(script, *words):
    """What lmp prints for a script."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "in.script"
        path.write_text(script)
        done = subprocess.run([lmp, "-in", path, "-log", "none", *words], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{script}\nends with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr}")
    return done.stdout


def expect(text, word, where):
    """A word by itself."""
    if not re.search(rf"(?<!\S){re.escape(word)}(?!\S)", text):
        sys.exit(f"{where} does not list {word}")


for kind, names in STYLES.items():
    listed = said(f"info styles {kind}\n")
    for name in names:
        expect(listed, name, f"info styles {kind}")
run = """
atom_style sphere
comm_modify vel yes
region box block 0 8 0 8 0 8
create_box 1 box
create_atoms 1 single 3.5 4 4
create_atoms 1 single 4.499 4 4
set group all diameter 1 density 1
pair_style granular/adhesive
pair_coeff 1 1 jkr 1.0e6 0.25 100
compute aggregates all aggregate/contact
fix move all nve/sphere/mts collision auto
thermo_style custom step c_aggregates[1]
thermo 1000000
timestep 1.0e-4
run 1000000000
print "after the run"
"""
if "after the run" not in said(run, "-skiprun"):    # else this run lasts for hours
    sys.exit("-skiprun: no end of the run")
print("command line: pass")
