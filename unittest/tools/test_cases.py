#!/usr/bin/python3
"""tools/cases: what it makes of records of tests, and which it does not let pass."""
import csv
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parent.parent.parent / "tools" / "cases"
LIST = """# number | case | tests | integrators without a row
1 | first | styles:A.* | respa, mts: none
2 | second | styles:B.* | verlet, respa: none
"""


class Cases(unittest.TestCase):
    """A tree with a list of two cases, and programs of tests that write what they are told."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        for name in ("tools", "unittest/stability", "unittest/styles", "build/unittest"):
            (self.root / name).mkdir(parents=True)
        shutil.copy(TOOL, self.root / "tools" / "cases")
        (self.root / "unittest/stability/cases.txt").write_text(LIST)
        (self.root / "build/CMakeCache.txt").write_text("LAMMPS_BUILD_DIR:PATH=/nowhere\n")

    def run_cases(self, tests, source="", more=()):
        """tests: {suite: [(test, {criterion: text})]}. Exit status, output, rows of the table."""
        for suite, members in tests.items():
            cases = "".join(
                f'<testcase name="{name}" classname="{suite}" status="run" result="completed"><properties>' +
                "".join(f'<property name="{key}" value="{text}"/>' for key, text in records.items()) +
                "</properties></testcase>" for name, records in members)
            (self.root / f"{suite}.xml").write_text(f"<testsuites><testsuite>{cases}</testsuite></testsuites>")
        program = self.root / "build/unittest/test_styles"
        listed = "".join(f"{suite}.\n" + "".join(f"  {name}\n" for name, _ in members)
                         for suite, members in tests.items())
        program.write_text('#!/bin/sh\n'
                           f'[ "$1" != --gtest_list_tests ] || {{ printf "{listed}"; exit; }}\n'
                           'suite=${1#--gtest_filter=}\n'
                           f'cp {self.root}/${{suite%%.*}}.xml "${{2#--gtest_output=xml:}}"\n')
        program.chmod(0o755)
        (self.root / "unittest/styles/test.cpp").write_text(source)
        table = self.root / "table.csv"
        table.unlink(missing_ok=True)
        done = subprocess.run([self.root / "tools" / "cases", self.root / "build", table, *more],
                              capture_output=True, text=True, check=False)
        if not table.exists():
            return done.returncode, done.stdout + done.stderr, None
        with open(table, newline="", encoding="utf-8") as rows:
            return done.returncode, done.stdout + done.stderr, list(csv.reader(rows))

    GOOD = {"A": [("a", {"C1 verlet: error": "0.5|0|1", "C2 verlet: of the other case": "1|0|2"})],
            "B": [("b", {"C2 mts: error": "0.5|0|1"})]}

    def test_rows_and_the_one_that_is_known_not_to_be_met(self):
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1"})], "B": [("b", {"C2 mts: error": "3|0|1|for a reason"})]}
        status, text, rows = self.run_cases(tests)
        self.assertEqual(status, 0, text)
        self.assertIn(["1", "first", "verlet: error: in [0, 1]", "0.5", "yes"], rows)
        self.assertIn(["2", "second", "mts: error: in [0, 1]", "3", "NO, as expected: for a reason"], rows)
        tests["B"][0][1]["C2 mts: error"] = "3|0|1"
        self.assertEqual(self.run_cases(tests)[0], 1)

    def test_criterion_without_a_row_fails(self):
        status, text, _ = self.run_cases(self.GOOD)
        self.assertEqual(status, 1)
        self.assertIn("no case shows what A.a recorded: C2 verlet: of the other case", text)
        for name in ("mts: without a number", "C3 mts: of no case"):
            tests = {"A": [("a", {"C1 verlet: error": "0|0|1", name: "0|0|1"})], "B": [("b", {"C2 mts: error": "0|0|1"})]}
            status, text, _ = self.run_cases(tests)
            self.assertEqual(status, 1, name)
            self.assertIn("no case shows what A.a recorded: " + name, text)

    def test_two_rows_of_one_name_fail(self):
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1"}), ("other", {"C1 verlet: error": "0.7|0|1"})],
                 "B": [("b", {"C2 mts: error": "0|0|1"})]}
        status, text, _ = self.run_cases(tests)
        self.assertEqual(status, 1)
        self.assertIn("A.a, A.other record rows of the same name: C1 verlet: error", text)

    def test_criterion_of_a_source_that_no_test_of_the_list_records_fails(self):
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1"})], "B": [("b", {"C2 mts: error at 3": "0|0|1"})]}
        source = 'record("C1 *: error");\nrecord("C2 mts: error at " + number);\n'
        self.assertEqual(self.run_cases(tests, source)[0], 0)
        status, text, _ = self.run_cases(tests, source + 'record("C2 *: forgotten");\n')
        self.assertEqual(status, 1)
        self.assertIn("unittest/styles/test.cpp: no test of the case records C2 *: forgotten", text)
        # a part of the list says nothing of the other cases
        self.assertEqual(self.run_cases(tests, 'record("C2 *: forgotten");\n', ["--only=1"])[0], 0)

    def test_pattern_without_a_test_fails(self):
        (self.root / "unittest/stability/cases.txt").write_text(LIST.replace("A.* |", "A.a*:A.forgotten* |"))
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1"})], "B": [("b", {"C2 mts: error": "0|0|1"})]}
        status, _, rows = self.run_cases(tests)
        self.assertEqual(status, 1)
        self.assertIn(["1", "first", "styles:A.forgotten*: none", "no such test", "NO"], rows)
        self.assertEqual([row[2] for row in rows if row[4] == "NO"], ["styles:A.forgotten*: none"])

    def test_rows_of_whole_flows(self):
        (self.root / "unittest/stability/cases.txt").write_text(LIST + "3 | third | styles:B.* | + flow.txt\n")
        (self.root / "bench/results").mkdir(parents=True)
        same = "  -0.01 +- 0.01 y"
        (self.root / "bench/results/flow.txt").write_text(
            "words\nscheme           setting  seeds\nsingle rate      1   8   -  -  -  -\n" +
            "".join(f"{scheme}  {seeds} {same} -3.2 +- 2.1 ? {size} {same} 0 3.9\n" for scheme, seeds, size in
                    (("respa            N=40", 3, "+4.0 +- 2.7 ?"), ("mts tolerance    0.01", 8, "+0.5 +- 0.2 y"),
                     ("mts auto, f2     0.05", 3, "+3.5 +- 1.2 n"))))
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1"})],
                 "B": [("b", {"C2 mts: error": "0|0|1", "C3 verlet: error": "0|0|1", "C3 respa: error": "0|0|1",
                              "C3 mts: error": "0|0|1"})]}
        status, text, rows = self.run_cases(tests)
        self.assertEqual(status, 0, text)
        flows = [row for row in rows if "t = 20" in row[2]]
        self.assertEqual([row[2].split(":")[0] for row in flows],
                         ["respa, N=40", "mts tolerance, 0.01", "mts auto, f2, 0.05"])
        self.assertEqual([row[3] for row in flows], ["+4.0 +- 2.7 %", "+0.5 +- 0.2 %", "+3.5 +- 1.2 %"])
        self.assertEqual([row[4].split(",")[0] for row in flows], ["undecided", "yes", "NO"])
        self.assertIn("1 undecided", text)
        # a miss that chance does not explain, or a large one, is one
        text = (self.root / "bench/results/flow.txt").read_text()
        for worse in ("+3.5 +- 0.5 n", "+6.0 +- 2.0 n"):
            (self.root / "bench/results/flow.txt").write_text(text.replace("+3.5 +- 1.2 n", worse))
            self.assertEqual(self.run_cases(tests)[0], 1, worse)
        # a file without such rows is none
        (self.root / "bench/results/flow.txt").write_text("words\n")
        self.assertEqual(self.run_cases(tests)[0], 1)

    def test_shares_of_energy_make_a_table(self):
        shares = "|".join(["0.1"] * 9 + ["1e-5"])
        tests = {"A": [("a", {"C1 verlet: error": "0.5|0|1", "ledger|verlet|1|all|1000|100|0.1": shares,
                              "ledger|mts|8|all|1000|100|0.1": shares})],
                 "B": [("b", {"C2 mts: error": "0|0|1"})]}
        self.assertEqual(self.run_cases(tests)[0], 0)
        with open(self.root / "ledger.csv", newline="", encoding="utf-8") as rows:
            head, *rows = csv.reader(rows)
        self.assertEqual(head[:6], ["integrator", "N", "modes", "spheres", "steps", "f3"])
        self.assertEqual([row[:2] for row in rows], [["verlet", "1"], ["mts", "8"]])
        self.assertEqual({len(row) for row in rows}, {len(head)})

    def test_cases_that_the_list_does_not_have_are_refused(self):
        status, text, rows = self.run_cases(self.GOOD, more=["--only=1,99,"])
        self.assertEqual((status, rows), (2, None), text)
        self.assertEqual(text.count("\n"), 1, text)
        self.assertIn("cases.txt, 1, 2; got 99, ", text)

    def test_folders_that_are_no_builds_are_refused(self):
        for folder, why in ((self.root / "nowhere", "must be a build folder"), (self.root / "build", "has no tests")):
            done = subprocess.run([self.root / "tools" / "cases", folder], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(why, done.stderr)


unittest.main()
