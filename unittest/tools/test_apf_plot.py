"""tools/apf_plot, apf_vtp and apf_read on files whose numbers are known."""
import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

TOOLS = Path(__file__).resolve().parent.parent.parent / "tools"
sys.path.append(str(TOOLS))
sys.dont_write_bytecode = True


def load(name):
    """A program of tools/ as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(TOOLS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


try:
    plot, vtp = load("apf_plot"), load("apf_vtp")
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)
import apf_read    # after the check that numpy is there

LOG = """LAMMPS (4 Jul 2026)
thermo 10
Per MPI rank memory allocation (min/avg/max) = 1 | 1 | 1 Mbytes
   Step          Time         c_agg[1]
         0   0              0
        10   0.5            4
WARNING: something in between
        20   1              8
Loop time of 2 on 1 procs for 20 steps with 5 atoms
Per MPI rank memory allocation (min/avg/max) = 1 | 1 | 1 Mbytes
   Step          Time         c_agg[1]
        20   1              8
        30   1.5            16
Loop time of 3 on 1 procs for 10 steps with 5 atoms
Maximum resident set size: 12.5 Mbytes
Per MPI rank memory allocation (min/avg/max) = 1 | 1 | 1 Mbytes
   Step          Temp
         0   7
        1"""

HISTORY = """# Time-averaged data for fix h
# TimeStep t[L/U] c_agg[1] c_agg[2]
0 0 1 10
5 0.5 2 20
10 1 3"""

CHUNKS = """# Chunk-averaged data for fix profile and group all
# Timestep Number-of-chunks Total-count
# Chunk Coord1 Ncount density/number vx
100 2 4
  1 0.25 0 0 0
  2 0.75 4 8 0.5
200 2 4
  1 0.25 1 2 0.125
  2 0.75 3 6 0.25
300 2 4
  1 0.25 1 2 0.125
"""

SIZES = """# Histogrammed data for fix sizes
# TimeStep Number-of-bins Total-counts Missing-counts Min-value Max-value
# Bin Coord Count Count/Total
50 3 9 0 1 3
1 1 3 0.33
2 2 0 0
3 3 6 0.67
"""

ZONES = """# Time-averaged data for fix zones
# TimeStep Number-of-rows
# Row f_w[9] f_w[15]
0 2
1 0 0
2 0 0
20 2
1 3 1e-6
2 5 2e-6
"""


def dump_of(step, rows, head="ATOMS id type element x y z vx vy vz radius c_agg[2]"):
    """One snapshot in LAMMPS's format."""
    return (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS pp pp ff\n"
            "0 1\n0 2\n0 3\nITEM: " + head + "\n" + "".join(row + "\n" for row in rows))


ATOMS = ["1 1 Si 0.5 0.25 0.125 1 2 3 0.1 1", "2 1 Si 0 0 1 0 0 0 0.1 2", "3 1 Si 1 1 1 0 0 0 0.2 2"]
GRID = ("ITEM: TIMESTEP\n40\nITEM: BOX BOUNDS pp ff pp\n0 3\n0 2\n-1 1\nITEM: DIMENSION\n2\n"
        "ITEM: GRID SIZE nx ny nz\n3 2 1\nITEM: GRID CELLS f_c:grid:data\n1\n2\n3\n4\n5\n6\n")


class Plot(unittest.TestCase):
    """Each test writes a file, and looks at the numbers that the figure holds."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, text, name="in"):
        path = Path(self.folder.name) / name
        path.write_text(text)
        return str(path)

    def draw(self, *words):
        """{label: (x, y)} of the curves, as the figure's lines have them, and the axes."""
        options = plot.arguments(list(words))
        figure, _ = plot.FIGURES[options.kind](options)
        self.addCleanup(plot.plt.close, figure)
        axes = figure.axes[0]
        return {line.get_label(): tuple(map(list, line.get_data())) for line in axes.lines}, axes

    def stops(self, call, *words):
        """The message with which a call ends."""
        with self.assertRaises(SystemExit) as stopped:
            call(*words)
        return str(stopped.exception)

    def test_log_joins_runs_and_leaves_out_what_is_cut_off(self):
        path = self.file(LOG)
        curves, axes = self.draw("log", path, "--x", "Time", "--y", "c_agg[1]", "--x-factor", "1000",
                                 "--x-unit", "ms", "--y-label", "in aggregates")
        self.assertEqual(curves, {"c_agg[1]": ([0, 500, 1000, 1500], [0, 4, 8, 16])})
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("Time [ms]", "in aggregates"))
        curves, _ = self.draw("log", path, "--y", "Temp")
        self.assertEqual(curves, {"Temp": ([0], [7])})
        self.assertEqual(apf_read.read_cost(path), (5.0, 12.5))

    def test_history_by_short_names(self):
        curves, _ = self.draw("log", self.file(HISTORY), "--x", "t", "--y", "c_agg[1]", "c_agg[2]")
        self.assertEqual(curves, {"c_agg[1]": ([0, 0.5], [1, 2]), "c_agg[2]": ([0, 0.5], [10, 20])})

    def test_a_step_written_twice_counts_once(self):
        curves, _ = self.draw("log", self.file(HISTORY.replace("10 1 3", "0 0 7 70\n5 0.5 8 80\n")), "--y", "c_agg[1]")
        self.assertEqual(curves, {"c_agg[1]": ([0, 5], [7, 8])})
        blocks = apf_read.read_blocks(self.file(ZONES + ZONES[ZONES.index("0 2"):].replace("3 1e-6", "4 1e-6")))
        self.assertEqual([(block.step, block["f_w[9]"][0]) for block in blocks], [(0, 0), (20, 4)])

    def test_table_of_a_study_keeps_rows_of_the_same_value(self):
        table = apf_read.read_history(self.file("# dust\n# gamma[J/m^2] seed stuck\n0.2 1 5\n0.2 2 7\n0.1 1 9\n"))
        self.assertEqual(table["stuck"].tolist(), [5, 7, 9])

    def test_profile(self):
        path = self.file(CHUNKS)
        curves, _ = self.draw("profile", path, "--y", "density/number", "vx", "--steps", "100", "200")
        self.assertEqual(curves["density/number step 100"], ([0.25, 0.75], [0, 8]))
        self.assertEqual(curves["vx step 100"], ([0.75], [0.5]))    # the first bin is empty
        self.assertEqual(curves["vx step 200"], ([0.25, 0.75], [0.125, 0.25]))

    def test_sizes(self):
        curves, axes = self.draw("sizes", self.file(SIZES))
        self.assertEqual(curves, {"step 50": ([1, 3], [3, 2])})    # 3 single ones, 2 aggregates of 3
        self.assertEqual(apf_read.read_blocks(self.file(SIZES))[0].totals, (9, 0, 1, 3))    # none beyond the bins, sizes 1 to 3
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        path = self.file(dump_of(0, ATOMS) + dump_of(7, ATOMS[1:]), "dump")
        curves, _ = self.draw("sizes", path, "--column", "c_agg[2]", "--steps", "0", "7")
        self.assertEqual(curves, {"step 0": ([1, 2], [1, 1]), "step 7": ([2], [1])})

    def test_deposit(self):
        curves, _ = self.draw("deposit", self.file(ZONES), "--zones", "floor", "all", "--x-factor", "0.5")
        self.assertEqual(curves, {"floor": ([0, 10], [0, 3]), "all": ([0, 10], [0, 5])})

    def test_curve_of_a_dump(self):
        path = self.file(dump_of(3, ["0.5 -1", "0.25 2"], "ENTRIES c_f[1] c_f[2]"))
        curves, _ = self.draw("curve", path, "--x", "c_f[1]", "--y", "c_f[2]")
        self.assertEqual(curves, {"c_f[2]": ([0.5, 0.25], [-1, 2])})

    def test_map(self):
        path = self.file(GRID)
        options = plot.arguments(["map", path, "--x-factor", "10", "--y-factor", "2"])
        figure, rows = plot.FIGURES["map"](options)
        self.addCleanup(plot.plt.close, figure)
        mesh = figure.axes[0].collections[0]
        self.assertEqual(mesh.get_array().reshape(2, 3).tolist(), [[2, 4, 6], [8, 10, 12]])
        self.assertEqual(mesh.get_coordinates()[0, :, 0].tolist(), [0, 10, 20, 30])    # edges of cells
        self.assertEqual([list(x) for _, x, _ in rows], [[5, 15, 25]] * 2)
        self.assertEqual(rows[1][0], "y = 15")

    def test_errors_name_file_and_column(self):
        path = self.file(LOG)
        said = self.stops(self.draw, "log", path, "--y", "c_agg[7]")
        self.assertEqual(said, f"{path}: no column c_agg[7]; it has Step Time c_agg[1]")
        said = self.stops(self.draw, "profile", self.file(CHUNKS), "--y", "vy")
        self.assertIn("no column vy; it has Chunk Coord1 Ncount density/number vx", said)
        said = self.stops(self.draw, "profile", self.file(CHUNKS), "--steps", "7")
        self.assertIn("no step 7; it has 100 200", said)
        self.assertIn("2 rows, but --zones has 1", self.stops(self.draw, "deposit", self.file(ZONES), "--zones", "a"))
        self.assertEqual(self.stops(self.draw, "log", "nowhere"), "nowhere: missing")
        self.assertIn("line 5: not numbers: 5 O.5 2 20", self.stops(
            self.draw, "log", self.file(HISTORY.replace("5 0.5", "\n5 O.5"))))
        self.assertIn("bins are not centered", self.stops(self.draw, "sizes", self.file(SIZES.replace("2 2 0", "2 1.5 0"))))
        self.assertIn("is no dump", self.stops(self.draw, "map", path))

    def test_cut_off_snapshot_is_left_out(self):
        shots = apf_read.read_dump(self.file(dump_of(0, ATOMS) + dump_of(9, ATOMS)[:-30]))
        self.assertEqual([shot.step for shot in shots], [0])

    def test_csv(self):
        table, picture = (str(Path(self.folder.name) / name) for name in ("out.csv", "out.svg"))
        sys.argv = ["apf_plot", "log", self.file(HISTORY), "--y", "c_agg[2]", "--csv", table, "--out", picture]
        plot.main()
        self.assertEqual(Path(table).read_text(), "curve,x,y\nc_agg[2],0,10\nc_agg[2],5,20\n")
        self.assertIn("<svg", Path(picture).read_text()[:2000])

    def test_vtp(self):
        shot = apf_read.read_dump(self.file(dump_of(0, ATOMS)))[0]
        piece = ElementTree.fromstring(vtp.poly_data(shot)).find("PolyData/Piece")
        arrays = {a.get("Name"): [float(word) for word in a.text.split()] for a in piece.iter("DataArray")}
        self.assertEqual(piece.get("NumberOfPoints"), "3")
        self.assertEqual(arrays["points"], [0.5, 0.25, 0.125, 0, 0, 1, 1, 1, 1])
        self.assertEqual(arrays["v"], [1, 2, 3, 0, 0, 0, 0, 0, 0])
        self.assertEqual(arrays["radius"], [0.1, 0.1, 0.2])
        self.assertEqual(arrays["offsets"], [1, 2, 3])
        self.assertIn("no columns x y z", self.stops(vtp.arrays_of, apf_read.read_dump(
            self.file(dump_of(0, ["1 2"], "ATOMS id type")))[0]))


if __name__ == "__main__":
    unittest.main()
