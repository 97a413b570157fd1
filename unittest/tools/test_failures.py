#!/usr/bin/python3
"""tools/failures: what it says of logs of ctest."""
import importlib.machinery
import importlib.util
import unittest
from pathlib import Path

PATH = Path(__file__).resolve().parent.parent.parent / "tools" / "failures"
LOADER = importlib.machinery.SourceFileLoader("failures", str(PATH))
failures = importlib.util.module_from_spec(importlib.util.spec_from_loader("failures", LOADER))
LOADER.exec_module(failures)


def test_of(name, *output):
    """Part of a test in LastTest.log."""
    return (f"1/9 Testing: {name}\n1/9 Test: {name}\nOutput:\n" + 58 * "-" + "\n" + "".join(line + "\n" for line in output) +
            "<end of output>\nTest time =   0.36 sec\n" + 58 * "-" + "\n")


class Failures(unittest.TestCase):
    """Names first, then what each test tells."""

    def test_failures_of_googletest_and_errors_come_before_noise(self):
        log = (test_of("passes", "fine: Failure to be ignored") +
               test_of("fails", "[ RUN      ]", "test.cpp:7: Failure", "Expected 1", "Actual 2") +
               test_of("script", "much", "is said", "script: error: no such style", "more"))
        self.assertEqual(failures.report(["fails", "script"], log),
                         ["2 failed: fails, script", "fails, 0.36 sec:", "    test.cpp:7: Failure", "    Expected 1",
                          "    Actual 2", "script, 0.36 sec:", "    script: error: no such style", "    more"])

    def test_without_a_word_the_end_is_shown(self):
        log = test_of("ends", *(f"line {n}" for n in range(100)))
        self.assertEqual(failures.report(["ends"], log)[2:], [f"    line {n}" for n in range(92, 100)])
        self.assertEqual(failures.report(["gone"], log), ["1 failed: gone", "gone, 0 sec:", "    was not run"])

    def test_many_fit_on_a_screen(self):
        names = [f"test{n}" for n in range(300)]
        lines = failures.report(names, "".join(test_of(name, *(["x.cpp:1: Failure"] + 50 * ["y" * 500])) for name in names))
        self.assertEqual(len(lines), failures.SCREEN + 1)
        self.assertLessEqual(max(map(len, lines[1:])), failures.WIDTH + 4)
        first = lines[0].split(": ")[1].split(" and ")
        self.assertEqual(first[1], f"{300 - len(first[0].split(', '))} more")
        self.assertLessEqual(len(lines[0]), 3 * failures.WIDTH)


unittest.main()
