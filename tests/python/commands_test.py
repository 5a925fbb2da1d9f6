"""`python3 -m contactsim`: what is refused before or without a server, and its exit codes."""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
from unittest import mock

import numpy as np
from contactsim import commands
from contactsim.figures import PRESETS, Curve, Figure, FigureError, Panel
from contactsim.figures.words import WORDS
from contactsim.paper import ITEMS

DASHBOARD = pathlib.Path(__file__).parents[2] / "client" / "web" / "src" / "model"


class CommandsTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, *words, stdin=""):
        """Exit code, and what was said."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()), \
                mock.patch("sys.stdin", io.StringIO(stdin)), \
                mock.patch.dict("os.environ", {"CONTACT_SERVER": "127.0.0.1:1"}):
            code = commands.main([str(word) for word in words])
        return code, said.getvalue()

    def test_what_is_wrong_is_told_with_the_exit_code_of_contactctl(self):
        for code, words, told in (
                (2, ("plot", "j", "force", "--size", "big"), "--size big"),
                (2, ("plot", "j"), "say what to draw"),
                (2, ("paper", "fig99", "--directory", self.folder), "unknown item 'fig99'"),
                (4, ("--timeout=0.2", "paper", "fig3", "--directory", self.folder), "cannot reach"),
                (11, ("paper", "fig3", "--directory", "/proc/nowhere"), "/proc/nowhere: No such")):
            with self.subTest(words):
                got, said = self.run_it(*words)
                self.assertEqual(got, code, said)
                self.assertIn(told, said)

    def test_library_that_is_missing_is_named_with_its_package(self):
        with mock.patch.dict("sys.modules", {"matplotlib": None}):
            code, said = self.run_it("paper", "fig3", "--format", "png")
        self.assertEqual(code, 11)
        self.assertIn("apt-get install python3-matplotlib", said)

    def test_columns_of_a_table_become_curves(self):
        path = self.folder / "a.csv"
        code, _ = self.run_it("curves", "--y-label", "α", "--ideal", "--file", path,
                              stdin="ε,A,B\n0.5,1,2\n1,3,4\n")
        self.assertEqual(code, 0)
        self.assertEqual(path.read_text("utf-8"), "curve,ε,α\nA,0.5,1\nA,1,3\nB,0.5,2\nB,1,4\n"
                         ",0,0\n,1,1\n")

    def test_logarithmic_axis_needs_a_value_above_zero(self):
        def figure(*y):
            curve = Curve("a", 0, np.zeros(len(y)), np.array(y))
            return Figure("", [Panel("x", "force [N]", [curve], lowest_y=0)])
        drawn = figure(-1.0, 2.0)
        commands._make_log(drawn)
        self.assertEqual((drawn.panels[0].log_y, drawn.panels[0].lowest_y), (True, None))
        with self.assertRaisesRegex(FigureError, "no value above 0"):
            commands._make_log(figure(-1.0, 0.0))

    def test_every_preset_has_a_title_in_the_table_of_words(self):
        self.assertLessEqual(set(PRESETS), set(WORDS["titles"]))
        source = "".join((DASHBOARD / name).read_text("utf-8") for name in (
            "presets.ts", "curves.ts", "hysteresis.ts", "iterations.ts"))
        self.assertEqual(re.findall(r"title: '", source), [])
        self.assertLessEqual(set(re.findall(r"titles\.(\w+)|titles\['([\w-]+)'\]", source)),
                             {pair for word in WORDS["titles"] for pair in ((word, ""), ("", word))})

    def test_items_of_the_paper_are_its_figures_and_tables(self):
        self.assertEqual(len(ITEMS), len(set(ITEMS)), ITEMS)
        self.assertEqual(len(ITEMS), 15)

    def test_contactctl_offers_the_same_presets_and_items(self):
        def said(*words):
            return subprocess.run([os.environ["CONTACTCTL"], *words], stderr=subprocess.PIPE,
                                  text=True, timeout=60).stderr
        offered = re.search(r"\{(.*)\}", said("plot", "last", "none"))
        self.assertEqual(offered[1].split(","), list(PRESETS))
        offered = re.search("one of (.*) or all", said("paper", "none"))
        self.assertEqual(offered[1].split(", "), list(ITEMS))


if __name__ == "__main__":
    unittest.main()
