#!/usr/bin/python3
"""Draws what has settled where, from what in.radiator wrote, and compares:   plot.py [DIR] [--keep]

Writes deposit.png, figure39.png (bar and particles), figure40.png (a slice before the bar) and compare.txt to DIR,
from all radiator-*.captured there; figure37.png (the grid of the air's computation) from `case`, figure38.png (the
air) from radiator.vtkhdf there or here.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from grids import read_grid
from mesh import Mesh, quads
from report import Run, arguments, conclude, draw_pictures, read_runs, values_by_run

SPEED = 1.667    # of the air at the inlet [m/s], as in in.radiator

ZONES = {"front": "front of the bar", "edges": "edges of the fins", "channels": "walls of the channels"}
# areas in mm^2: the front with its round corners; the fins behind their round edges, 1.8 mm long, both faces
AREA = {"front": 1.2 * (0.6 + np.pi * 0.2), "channels": 2 * 2 * 1.0 * 1.8}


def words(run):
    """The run in words."""
    phi, _, wet = run.name.split("-")[:3]
    return f"phi = {phi[3:]}, {'moist' if wet == 'yes' else 'dry'}"


def values_of(run):
    """The quantities of report.csv."""
    zones = run.history
    per_area = {zone: zones[zone][-1] / area for zone, area in AREA.items()}
    quarters = np.diff(np.interp(run.t[-1] * np.linspace(0, 1, 5), run.t, zones["all"]))
    pairs = {"deposited per area: front / channels": (per_area["front"], per_area["channels"]),
             "deposition rate: last / second quarter": (quarters[3], quarters[1])}
    return {key: above / below if below else np.nan for key, (above, below) in pairs.items()}


def draw(runs, path):
    """What settles where, over time."""
    figure, axes = plt.subplots(1, len(runs), figsize=(5.5 * len(runs), 3.8), layout="constrained",
                                squeeze=False, sharey=True)
    for axis, run in zip(axes[0], runs):
        for zone, label in ZONES.items():
            axis.plot(run.t, run.history[zone], linewidth=1, label=label)
        axis.set(xlabel="t  [L/U]", ylabel="deposited particles", title=words(run))
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def both_halves(polygons):
    """The mesh is mirrored at the middle of the bar."""
    return np.concatenate([polygons, polygons * (1, -1, 1)])


def draw_mesh(mesh, path):
    """The grid on the walls, and the blocks of the half with y > 0 (figure 37)."""
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.4), subplot_kw={"projection": "3d"})
    walls = {patch: both_halves(np.concatenate([quads(mesh.face(corners)) for corners in faces]))
             for patch, faces in mesh.patches.items() if patch in ("bar", "fins")}
    blocks = {k: np.concatenate([quads(nodes) for nodes in mesh.block_faces(block)])
              for k, block in enumerate(mesh.blocks)}
    for axis, parts in zip(axes, (walls, blocks)):    # one collection each, so that what is behind is hidden
        colours = np.repeat([f"C{k}" for k in range(len(parts))], [len(part) for part in parts.values()])
        axis.add_collection3d(Poly3DCollection(np.concatenate(list(parts.values())), facecolors=colours,
                                               edgecolors="k", linewidths=0.12))
    axes[0].set(xlim=(0, 4), ylim=(-1.5, 1.5), yticks=(-1, 0, 1), title="(a) grid on the bar (blue) and the fin (orange)")
    axes[0].set(xlabel="x [mm]", ylabel="y [mm]")
    axes[1].set(xlim=(-5, 4), ylim=(0, 1.5), yticks=(), title="(b) blocks of the half 0 < y < 1.5 mm, from the side of the bar")
    axes[1].text2D(0.45, 0.2, "x [mm]", transform=axes[1].transAxes)    # a label lies on the numbers
    for axis, side, zoom in zip(axes, (-125, -70), (1.1, 1.2)):
        axis.view_init(28, side)
        axis.set(zlim=(-0.6, 0.6), zticks=(-0.6, 0.6))
        axis.set_box_aspect([high - low for low, high in (axis.get_xlim(), axis.get_ylim(), axis.get_zlim())], zoom=zoom)
    figure.subplots_adjust(left=0.03, right=0.97, bottom=0, top=0.92, wspace=0.05)
    figure.savefig(path, dpi=110)


def draw_air(grid, path):
    """Velocity along x in a plane through the middle of a channel and in two upright planes (figure 38)."""
    u = grid.fluid(grid["velocity"][..., 0]) / SPEED
    x, y, z = (1e3 * nodes for nodes in (grid.x, grid.y, grid.z))
    middle, side = abs(y).argmin(), abs(y - 1).argmin()
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.5), layout="constrained", width_ratios=(1, 1.1, 1.1))
    for axis, up, plane, title in ((axes[0], y, u[-1], "(a) z = 0.6 mm, middle of a channel"),
                                   (axes[1], z, u[:, middle], "(b) y = 0, before the middle of the bar"),
                                   (axes[2], z, u[:, side], "(c) y = 1 mm, between two bars")):
        image = axis.contourf(x, up, plane, np.arange(0, 2.9, 0.2), cmap="viridis")
        axis.set(aspect="equal", xlabel="x [mm]", title=title, facecolor="0.8")
    axes[0].set_ylabel("y [mm]")
    axes[1].set_ylabel("z [mm]")
    figure.colorbar(image, ax=axes, label="u / U", aspect=25)
    figure.get_layout_engine().set(h_pad=0.1)
    figure.savefig(path, dpi=110)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = read_runs(folder, "radiator-*.captured", lambda path: Run(path, "radiator-"), kept and HERE)
    draw_mesh(Mesh(), out / "figure37.png")
    air = read_grid("radiator.vtkhdf", ["velocity", "inside"], folder, HERE)
    if air:
        draw_air(air, out / "figure38.png")
    draw(runs, out / "deposit.png")
    early = [(f"{words(run)}, t = {t:g} L/U", path) for run in runs for t, path in zip(*run.pictures()) if t in (4, 16)]
    if early:
        draw_pictures(early, 2, out / "figure39.png", (4.4, 3.2), trim=True)
    ends = [(f"{words(run)}, t = {times[-1]:g} L/U", paths[-1]) for run in runs
            for times, paths in [run.pictures(".slice")] if paths]
    if ends:
        draw_pictures(ends, 2, out / "figure40.png", (6, 3.2))
    conclude(HERE, values_by_run(runs, values_of),
             [run.cost(f"{run.history['entered'][-1]:.0f} entered") for run in runs], out, kept)


if __name__ == "__main__":
    main()
