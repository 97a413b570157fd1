"""examples/report.py: what a run cost, and the verdict on a number, from files and numbers that are known."""
import sys
import tempfile
import unittest
from pathlib import Path
from runpy import run_path

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples"
sys.path.append(str(EXAMPLES))
sys.dont_write_bytecode = True
try:
    import report
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

HEAD = "pair_coeff 1 1 ${law}\npair_coeff 1 1 jkr 1e9 0.3 0.1\ntimestep ${dt}\ntimestep 2e-06\n"
PIECE = ("Loop time of {} on 2 procs for {} steps with 5 atoms\n\nPerformance: 1 tau/day\n{}% CPU use with 2 MPI tasks\n"
         "Maximum resident set size: {} Mbyte\n")
NAN = float("nan")


class Cost(unittest.TestCase):
    """A run of 100 steps, of which the log knows some."""

    def cost(self, log):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "case-a.history"
            path.write_text("# title\n# step t[s] n\n0 0 1\n50 5 2\n100 10 3\n")
            path.with_suffix(".log").write_text(log)
            return report.Run(path, "case-").cost("5 particles")

    def test_all_pieces_of_a_run_on_all_ranks(self):
        row = self.cost(HEAD + PIECE.format(10, 40, 50, 7) + "Loop time of 1e-6 on 2 procs for 0 steps with 5 atoms\n\n"
                        "259% CPU use with 2 MPI tasks\n" + PIECE.format(30, 60, 100, 9))
        self.assertEqual(row, {"run": "case-a", "t": "10", "ranks": "2", "wall-clock [s]": "40", "CPU [s]": "70", "MB": "9",
                               "parameters": "5 particles; jkr 1e9 0.3 0.1; timestep 2e-06"})

    def test_parameters_name_drag_and_inlet(self):
        scene = ("fix drag all flow/force air drag stokes ${forces}\nfix drag all flow/force air drag stokes torque yes\n"
                 "fix in all inlet/flow x $(-L) air number ${n} every 10 diameter 1\n"
                 "fix in all inlet/flow x -2.500000000e-05 air {} type 1\n")
        for words, told in (("number 25 every 10 diameter 1e-6", "number 25 every 10 steps"),
                            ("concentration 0.05 diameter 1e-6", "concentration 0.05")):
            row = self.cost(HEAD + scene.replace("{}", words))
            self.assertEqual(row["parameters"], "5 particles; jkr 1e9 0.3 0.1; drag stokes torque yes; "
                             f"inlet at x = -2.5e-05, {told}; timestep 2e-06")

    def test_pieces_without_a_time_are_scaled_in_or_left_out(self):
        row = self.cost(HEAD + PIECE.format(30, 60, 100, 9))
        self.assertEqual((row["wall-clock [s]"], row["CPU [s]"]), ("50", "100"))
        row = self.cost(HEAD + PIECE.format(10, 40, 50, 7))
        self.assertEqual((row["wall-clock [s]"], row["CPU [s]"], row["MB"]), ("", "", "7"))

    def test_log_that_is_no_text_costs_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "case-a.history"
            path.write_text("# title\n# step t[s] n\n0 0 1\n50 5 2\n")
            path.with_suffix(".log").write_bytes(b"ERROR: \xd4\xff\n")
            self.assertEqual(report.Run(path, "case-").cost("")["MB"], "")


class Verdict(unittest.TestCase):
    """A number beside the report's 2 .. 3, which it gives for t > 50."""

    def test_words(self):
        row = {"low": 2.0, "value": NAN, "high": 3.0, "for_t": "> 50"}
        for value, spread, t, words in ((2.0, NAN, 60, "agrees"), (3.0, NAN, 60, "agrees"), (3.01, NAN, 60, "differs"),
                                        (3.01, 0.02, 60, "agrees within our spread"), (1.9, 0.05, 60, "differs"),
                                        (NAN, NAN, 60, "not reached"), (2.5, NAN, 49, "not reached: run ended at t = 49")):
            self.assertEqual(report.verdict(row, report.Ours(value, spread, t)), words)
        self.assertEqual(report.verdict({**row, "low": NAN, "high": NAN}, report.Ours(1, t=60)), "no number")

    def test_what_swings_by_more_than_the_range_and_half_of_itself_is_no_number(self):
        row = {"low": 2.0, "value": NAN, "high": 3.0, "for_t": ""}
        for value, spread, words in ((2.5, 1.3, "no number: varies by 1.3"), (1.5, 1.3, "no number: varies by 1.3"),
                                     (2.5, 0.9, "agrees"), (2.5, 1.2, "agrees"), (6.0, 2.9, "differs"), (6.0, 4.5, "no number: varies by 4.5")):
            self.assertEqual(report.verdict(row, report.Ours(value, spread, 60)), words)
        self.assertEqual(report.verdict({**row, "high": NAN}, report.Ours(2.5, 2.0, 60)), "agrees")


class Keep(unittest.TestCase):
    """What an example keeps: a run to t = 100, which a shorter one of its name does not replace."""

    def test_shorter_run_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            example, key = Path(folder), ("a", "share")

            def keep(t, share):
                report.keep(example, {key: report.Ours(share, t=t)}, [{"run": "case-a", "t": f"{t:g}"}])

            keep(100, 0.5)
            with self.assertRaises(SystemExit) as refused:
                keep(8, 0.1)
            self.assertRegex(str(refused.exception.code), "case-a is kept to t = 100, this run ended at 8; nothing is kept")
            self.assertEqual(report.read_kept(example)[0][key].value, 0.5)
            for t, share in ((100, 0.6), (120, 0.7)):
                keep(t, share)
                self.assertEqual(report.read_kept(example)[0][key].value, share)


class Times(unittest.TestCase):
    """examples/report: what a full variant takes, where it has been measured to its end."""

    def test_whole_runs_alone(self):
        times = run_path(str(EXAMPLES / "report"))["times"]
        rows = [dict(zip(("run", "to t", "ranks", "wall-clock [s]", "MB", "processor"), words.split(",")))
                for words in ("a-x,,2,300,9,P", "a-x,5,2,9,9,P", "a-y,,1,80.4,9,P", "a-z,20,2,48,9,P", "a,,2,3.5,7,P",
                              "b-x,,1,70,9,P", "b-x,,2,40,9,P", "b-y,,1,90,9,Q", "b-y,,2,50,9,P")]
        runs = {name: {"run": name, "t": "100", "CPU [s]": "", "MB": "8"} for name in ("a-x", "a-y", "a-z", "b-x", "b-y")}
        full, quick = times({"a": runs}, rows)
        self.assertEqual([(row["one rank [s]"], row["two ranks [s]"], row["processor"]) for row in full],
                         [("", "300", "P"), ("80", "", "P"), ("", "", ""), ("70", "40", "P"), ("", "50", "P")])
        self.assertEqual(quick, [{"example": "a", "two ranks [s]": "3.5", "MB": "7"}])

    def test_sum_of_costs_tells_how_many_are_known(self):
        costs = run_path(str(EXAMPLES / "report"))["costs"]
        runs = [{"wall-clock [s]": "10", "CPU [s]": "20"}, {"wall-clock [s]": "", "CPU [s]": "5"}]
        self.assertEqual(costs(runs), {"wall-clock [s] of all": "10 (1 of 2 runs)", "CPU [s] of all": "25"})


if __name__ == "__main__":
    unittest.main()
