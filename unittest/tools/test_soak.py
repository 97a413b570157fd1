#!/usr/bin/python3
"""unittest/stability/soak: words that cannot be are refused in one line."""
import subprocess
import unittest
from pathlib import Path

SOAK = Path(__file__).resolve().parent.parent / "stability" / "soak"


class Soak(unittest.TestCase):
    def refused(self, *words):
        """What it says; the program, where it is one, must not be run."""
        done = subprocess.run([SOAK, *words], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_goals(self):
        for goal in ("1e4", "99999", "abc", "nan", "inf", "-1e6"):
            self.assertIn(f"GOAL must be a number of collision steps >= 100000, got {goal}", self.refused("echo", goal))

    def test_programs(self):
        for program in ("/nowhere/lmp", str(SOAK.parent)):
            self.assertIn(f"LMP must be a program that can be run, got {program}", self.refused(program))

    def test_variables(self):
        for word in ("rounds", "rounds=", "=5"):
            self.assertIn(f"NAME=VALUE, got {word}", self.refused("echo", "1e5", word))


unittest.main()
