"""The grid that OpenFOAM's blockMesh makes of the dictionary in `case`, for plot.py: blocks, and faces of their surface.

Reads no more of it than is used there: named vertices, hexahedra with simpleGrading, arcs, patches.
"""
import re
from itertools import product
from pathlib import Path

import numpy as np

SYSTEM = Path(__file__).resolve().parent / "case" / "system"
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]    # order of OpenFOAM
POINT = r"\(([-\d.]+) ([-\d.]+) ([-\d.]+)\)"


class Mesh:
    """Blocks of the half with y > 0; lengths in mm."""

    def __init__(self):
        numbers = dict(re.findall(r"\b(\w+) +(\d+);", (SYSTEM / "mesh").read_text()))
        text = re.sub("//.*", "", (SYSTEM / "blockMeshDict").read_text())
        text = re.sub(r"\$(\w+)", lambda found: numbers[found[1]], text)
        self.points = {name: np.array(xyz, float) for name, *xyz in re.findall(rf"name (\w+) {POINT}", text)}
        self.arcs = {(a, b): np.array(xyz, float) for a, b, *xyz in re.findall(rf"arc (\w+) (\w+) {POINT}", text)}
        self.blocks = [(dict(zip(corners.split(), CORNERS)), [int(n) for n in cells.split()], [float(r) for r in ratios.split()])
                       for corners, cells, ratios
                       in re.findall(r"hex \(([^)]*)\) *\(([^)]*)\) +simpleGrading \(([^)]*)\)", text)]
        self.patches = {name: [words.split() for words in re.findall(r"\(((?:\w+ ){3}\w+)\)", faces)]
                        for name, faces in re.findall(r"(\w+)\s*\{[^}]*faces(.*?)\}", text, re.S)}

    def edge(self, a, b, shares):
        """Points at shares of the way from vertex a to b, straight or along an arc."""
        start, end = self.points[a], self.points[b]
        middle = self.arcs.get((a, b), self.arcs.get((b, a)))
        if middle is None:
            return start + shares[:, None] * (end - start)
        m, e = middle - start, end - start
        normal = np.cross(m, e)
        center = start + np.cross((m @ m) * e - (e @ e) * m, normal) / (2 * normal @ normal)
        u = start - center
        v = np.cross(normal / np.linalg.norm(normal), u)
        angle = np.arctan2((end - center) @ v, (end - center) @ u) % (2 * np.pi) * shares[:, None]
        return center + np.cos(angle) * u + np.sin(angle) * v

    def face(self, corners):
        """Nodes [i, j] on the face of a block with these four vertices."""
        place, cells, ratios = next(block for block in self.blocks if set(corners) <= set(block[0]))
        a, b, c, d = corners

        def shares(first, last):
            step = np.subtract(place[last], place[first])
            axis = np.flatnonzero(step)[0]
            sizes = ratios[axis] ** np.linspace(0, 1, cells[axis])
            return np.append(0, np.cumsum(sizes if step[axis] > 0 else sizes[::-1])) / sizes.sum()

        s, t = shares(a, b), shares(b, c)
        across, along = s[:, None, None], t[None, :, None]
        flat = sum(self.points[name] * p * q for name, p, q in
                   ((a, 1 - across, 1 - along), (b, across, 1 - along), (c, across, along), (d, 1 - across, along)))
        return ((1 - along) * self.edge(a, b, s)[:, None] + along * self.edge(d, c, s)[:, None]
                + (1 - across) * self.edge(a, d, t) + across * self.edge(b, c, t) - flat)

    def block_faces(self, block):
        """Nodes of its six faces."""
        at = {place: name for name, place in block[0].items()}
        for axis, side in product(range(3), (0, 1)):
            yield self.face([at[tuple(np.insert(pair, axis, side))] for pair in ((0, 0), (1, 0), (1, 1), (0, 1))])


def quads(nodes):
    """Quadrilaterals between nodes [i, j]."""
    return np.stack([nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]], axis=2).reshape(-1, 4, 3)
