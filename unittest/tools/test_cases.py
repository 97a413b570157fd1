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
        program.write_text('#!/bin/sh\nsuite=${1#--gtest_filter=}\n'
                           f'cp {self.root}/${{suite%%.*}}.xml "${{2#--gtest_output=xml:}}"\n')
        program.chmod(0o755)
        (self.root / "unittest/styles/test.cpp").write_text(source)
        table = self.root / "table.csv"
        done = subprocess.run([self.root / "tools" / "cases", self.root / "build", table, *more],
                              capture_output=True, text=True, check=False)
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


unittest.main()
