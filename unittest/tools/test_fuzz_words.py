#!/usr/bin/env python3
"""The fuzzer of commands knows each keyword and choice that a page has in its Syntax, or it would never try it."""
import glob
import os
import re
import unittest

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGES = ("apf_advise", "compute_*", "fix_*", "pair_*")
# names of values and of parts, and what is no command of a user
NOT_TRIED = {"fix_contact_history": {"contact/history", "hybrid"}, "fix_flow_field": {"graddim"},
             "fix_inlet_flow": {"position"}, "fix_wall_levelset": {"distance_", "rest", "total", "v_name"}}


def words_of(page):
    """Words in * * between Syntax and Examples: what is typed as it is"""
    with open(page) as file:
        syntax = re.search(r'^Syntax\n"+\n(.*?)^Examples\n', file.read(), re.M | re.S)
    words = re.findall(r"(?<![\w*])\*([a-z][a-z_/ ]*)\*(?![\w*])", syntax[1]) if syntax else []
    return {word for found in words for word in found.split() if len(word) > 1}


def read(name):
    """Text of a file of the checkout."""
    with open(os.path.join(root, name)) as file:
        return file.read()


class Words(unittest.TestCase):
    def test_all_options_of_flowgrid_are_tried(self):
        syntax = read("doc/src/flowgrid.rst").split("* options:")[1].split("Examples")[0]
        options = set(re.findall(r"^ +(--[a-z-]+)", syntax, re.M))
        tried = set(re.findall(r"--[a-z-]+", read("unittest/fuzz/fuzz_flowgrid.cpp").split("const std::string commands")[1]))
        self.assertGreater(len(options), 15)
        self.assertEqual(options - tried, {"--wall"})    # of an OpenFOAM case, which is many files

    def test_all_words_of_the_pages_are_tried(self):
        with open(root + "/unittest/fuzz/commands.h") as file:
            text = re.sub(r'"\s*\n\s*"', "", file.read())    # one command may be several strings
        tried = {word for string in re.findall(r'"((?:[^"\\\n]|\\.)*)"', text) for word in re.split(r"\s|\\n", string)}
        pages = [page for name in PAGES for page in glob.glob(f"{root}/doc/src/{name}.rst")]
        self.assertGreater(len(pages), 8)
        missing = {}
        for page in pages:
            name = os.path.basename(page)[:-4]
            left = words_of(page) - tried - NOT_TRIED.get(name, set())
            if left:
                missing[name] = sorted(left)
        self.assertEqual(missing, {})


unittest.main()
