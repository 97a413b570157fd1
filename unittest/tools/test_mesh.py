"""examples/radiator/mesh.py: nodes on the walls, where the shapes of the bar and the fin say; margins of pictures."""
import sys
import unittest
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples"
sys.path[:0] = [str(EXAMPLES), str(EXAMPLES / "radiator")]
sys.dont_write_bytecode = True
try:
    import mesh
    import numpy as np
    import report
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)


def area(quads):
    """Area of plane or nearly plane quadrilaterals."""
    return np.linalg.norm(np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]), axis=1).sum() / 2


class Walls(unittest.TestCase):
    """The bar: half a width of 0.5, corners of radius 0.2; the fin: 0.2 thick, its front a cylinder of radius 0.1."""

    def setUp(self):
        grid = mesh.Mesh()
        self.quads = {name: np.concatenate([mesh.quads(grid.face(corners)) for corners in grid.patches[name]])
                      for name in ("bar", "fins")}
        self.grid = grid

    def test_nodes_of_the_bar(self):
        x, y, _ = self.quads["bar"].reshape(-1, 3).T
        off = np.where(y < 0.3, x, np.where(x < 0.2, np.hypot(x - 0.2, y - 0.3) - 0.2, y - 0.5))
        self.assertLess(abs(off).max(), 1e-9)

    def test_nodes_of_the_fin(self):
        x, _, z = self.quads["fins"].reshape(-1, 3).T
        off = np.where(x < 0.6, np.hypot(x - 0.6, z), abs(z)) - 0.1
        self.assertLess(abs(off).max(), 1e-9)

    def test_faces_cover_the_walls_once(self):
        bar = 1.2 * (0.3 + 0.1 * np.pi + 3.8) - (3.4 * 0.2 + np.pi / 2 * 0.01)    # less where the fin is
        self.assertAlmostEqual(area(self.quads["bar"]) / bar, 1, delta=2e-3)
        self.assertAlmostEqual(area(self.quads["fins"]) / (0.1 * np.pi + 2 * 3.4), 1, delta=2e-3)

    def test_cells_of_the_blocks(self):
        """What the surfaces of all blocks are made of: twice the products of the cells along two axes."""
        for block in self.grid.blocks:
            a, b, c = block[1]
            self.assertEqual(sum(len(mesh.quads(nodes)) for nodes in self.grid.block_faces(block)), 2 * (a * b + b * c + c * a))


class Margins(unittest.TestCase):
    """A picture without its white margins."""

    def test_trimmed(self):
        picture = np.ones((6, 9, 3))
        picture[2, 3] = picture[4, 7] = (0.2, 1, 1)
        self.assertEqual(report.trimmed(picture).shape, (3, 5, 3))
        self.assertEqual(report.trimmed(np.ones((4, 5, 3))).shape, (4, 5, 3))


if __name__ == "__main__":
    unittest.main()
