"""Runs a Howto page as its reader would: howto.py PAGE.rst PROGRAMS...

Blocks with a caption are files: they are written under that name. Blocks of language bash are typed,
in their order, in one shell that stops at the first failure. PROGRAMS (lmp, flowgrid) stand in the
folder of the commands as ./NAME, beside examples, tools and potentials of the checkout. A block that
a comment ".. is FILE" precedes is what the commands have written there: the same words, numbers
within a fifth, and counts within that or 3, as other processors round otherwise and dust is chaotic.
Exit code 77: skipped, because a command that the page needs is not there.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^\.\. code-block:: (\w+)\n((?:   :\w+:.*\n)*)\n((?:   .*\n|\n)+)", re.M)


def blocks(page):
    """(language, caption or None, text) of the code blocks of a page."""
    for language, options, text in BLOCK.findall(page.read_text()):
        caption = re.search(r":caption: (\S+)", options)
        yield language, caption and caption[1], re.sub(r"^   ", "", text.rstrip() + "\n", flags=re.M)


SHOWN = re.compile(r"^\.\. is (\S+)\n\n\.\. parsed-literal::\n\n((?:   .*\n)+)", re.M)


def differs(shown, written):
    """Whether two words do, or two numbers by too much."""
    try:
        a, b = float(shown), float(written)
    except ValueError:
        return shown != written
    count = re.fullmatch(r"\d+", shown) and re.fullmatch(r"\d+", written)
    return abs(a - b) > max(0.2 * abs(b), 3 if count else 0)


def compare(page, folder):
    """Ends with the first line of a shown file that was written otherwise."""
    for name, text in SHOWN.findall(page.read_text()):
        shown, written = text.splitlines(), (folder / name).read_text().splitlines()
        if len(shown) != len(written):
            sys.exit(f"{page.name} shows {len(shown)} lines of {name}, {len(written)} were written")
        for one, other in zip(shown, written):
            words, others = one.split(), other.split()
            if len(words) != len(others) or any(map(differs, words, others)):
                sys.exit(f"{page.name} shows of {name}\n   {one.strip()}\nbut written was\n   {other}")


def main():
    """Writes the files, runs the commands."""
    page, programs = Path(sys.argv[1]), sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name in ("examples", "tools", "potentials"):
            (folder / name).symlink_to(ROOT / name)
        for program in programs:
            (folder / Path(program).name).symlink_to(program)
        commands = "set -e\n"
        for language, name, text in blocks(page):
            if name:
                (folder / name).write_text(text)
            elif language == "bash":
                commands += text
        for tool in set(re.findall(r"^(?:\./)?(flowgrid|mpirun|blockMesh)\b", commands, re.M)):
            if not (folder / tool).exists() and not shutil.which(tool):
                print(f"skipped: {page.name} needs {tool}")
                sys.exit(77)
        shell = subprocess.run(["bash", "-x", "-c", commands], cwd=folder, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, check=False)
        if shell.returncode:
            sys.exit(shell.stdout[-3000:] + f"\n{page.name}: exit code {shell.returncode}")
        compare(page, folder)
        print(f"{page.name}: {commands.count(chr(10)) - 1} lines of commands")


main()
