"""Figures as files: each format is drawn, tells where the figure comes from, and is the same again."""

import pathlib
import re
import subprocess
import tempfile
import unittest

import numpy as np
from contactsim.figures import PRESETS, Curve, Figure, Panel, preset_figure
from contactsim.figures.characters import text
from contactsim.figures.draw import drawn
from contactsim.figures.files import format_of, inline, rendered, save
from contactsim.figures.figure import FigureError, keep_largest
from contactsim.figures.look import Look
from matplotlib.colors import to_rgb
from PIL import Image
from sample_run import row_run, sample_run, stored_run

STARTS = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF", "eps": b"%!PS", "pgf": b"% title: "}
NASTY = r"it's \input{pwned} 100% {a}_b ^~#&$ $x$ μ |x|<y>"


class DrawingTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.run_ = stored_run("chain")

    def draw(self, form, preset="force", look=Look(), run=None):
        return rendered(preset_figure(preset, run or self.run_), form, look)

    def test_every_format_is_drawn_and_the_same_each_time(self):
        for form, start in STARTS.items():
            drawn = self.draw(form)
            self.assertTrue(drawn.startswith(start), drawn[:40])
            self.assertEqual(self.draw(form), drawn, form)

    def test_many_lines_are_coloured_by_their_place_but_not_in_print(self):
        x = np.arange(5.0)
        curves = [Curve(f"c{place}", place, x, place * x) for place in range(30)]
        figure = Figure("", [Panel("time [s]", "velocity [m/s]", curves)])
        keep_largest(figure)
        ax = drawn(figure).axes[0]
        small = ax.collections[0].get_colors()
        self.assertEqual(len({tuple(colour) for colour in small}), 20)
        green = np.array([to_rgb(line.get_color())[1] for line in ax.lines])
        self.assertTrue((np.diff(green) > 0).all())  # Of viridis it grows.
        self.assertGreater(green[0], small[-1][1])
        self.assertEqual(ax.get_xlim()[1], drawn(figure, Look(style="paper")).axes[0].get_xlim()[1])
        self.assertEqual(len(drawn(figure, Look(style="paper")).axes[0].collections), 0)
        self.assertIn("20 smaller", [text.get_text() for text in ax.get_legend().get_texts()])

    def test_keys_and_labels_leave_room_in_a_column(self):
        figure = preset_figure("force", row_run(5))
        self.assertEqual(len(figure.panels[0].labels), 5)
        for style, labels, entries in (("colour", 5, 10), ("springer", 0, 6)):
            ax = drawn(figure, Look(style=style)).axes[0]
            words = [text.get_text() for text in ax.get_legend().get_texts()]
            self.assertEqual(sum(word != "in contact" for word in words), entries, words)
            self.assertEqual(sum("μ/k" in text.get_text() for text in ax.texts), labels)

    def test_every_preset_is_drawn_for_latex_and_in_eighty_characters(self):
        newer = {"acceleration", "energy", "supports"}  # Than the server that made the stored run.
        for preset in set(PRESETS) - newer:
            if not preset.endswith("-map"):  # Which is a bitmap.
                self.assertIn(rb"\begin{pgfpicture}", self.draw("pgf", preset))
            lines = text(preset_figure(preset, self.run_), 80).splitlines()
            self.assertEqual(lines[0].strip(), "Triple-ball chain")
            self.assertLessEqual(max(map(len, lines)), 80, preset)
            self.assertTrue(any(re.match(r" *\+- \S.* -+\+", line) for line in lines), preset)
            self.assertTrue(lines[-1].startswith(self.run_.name + " ("), lines[-1])

    def test_every_file_tells_where_it_comes_from(self):
        job = self.run_.job
        told = [f"title: {job.scenario.title}", f"job: {job.name}",
                f"scenario_sha256: {job.spec_sha256}", f"version: {job.server_version}",
                f"revision: {job.server_revision}"]
        for form in STARTS:
            save(preset_figure("force", self.run_), self.folder / f"a.{form}")
        svg = (self.folder / "a.svg").read_text("utf-8")
        described = re.search("<dc:description>(.*?)</dc:description>", svg, re.DOTALL)
        self.assertEqual(described[1].splitlines(), told)
        png = Image.open(self.folder / "a.png").text
        self.assertEqual((png["Title"], png["Description"].splitlines()),
                         ("Triple-ball chain", told))
        pdf = subprocess.run(["pdfinfo", self.folder / "a.pdf"], check=True, text=True,
                             capture_output=True, timeout=60).stdout
        for line in ("Title:           Triple-ball chain", *told):
            self.assertIn(line, pdf)
        for form in ("eps", "pgf"):
            lines = (self.folder / f"a.{form}").read_text("utf-8").splitlines()
            for line in told:
                self.assertIn(f"% {line}", lines, form)

    def test_words_of_a_user_are_shown_and_become_no_commands(self):
        run = sample_run()
        run.job.scenario.title = NASTY
        tex = self.draw("pgf", run=run).decode()
        drawn = "".join(line for line in tex.splitlines() if not line.startswith("%"))
        self.assertNotIn(r"\input{", drawn)
        self.assertIn(r"\textbackslash{}input\{pwned\} 100\% \{a\}\_b", drawn)
        self.assertIn("pwned", self.draw("svg", run=run).decode())
        run.job.scenario.title = "one\nset output 'pwned'\x1b[2J"
        for form in ("pgf", "eps"):
            self.assertIn(b"% title: one set output 'pwned' [2J\n", self.draw(form, run=run))

    def test_figure_looks_as_it_is_asked_to(self):
        plain = self.draw("svg").decode()
        self.assertIn("time [ms]", plain)
        look = Look(size=(3, 2), family="Courier", points=9, title=False, provenance=False,
                    units=["us", "kN"])
        asked = self.draw("svg", look=look).decode()
        self.assertIn('width="216pt" height="144pt"', asked)
        texts = "".join(re.findall(r"<text[^>]*>([^<]*)</text>", asked))
        for seen, there in (("time [µs]", True), ("force [kN]", True),
                            ("Triple-ball chain", False), (self.run_.name, False)):
            self.assertEqual(seen in texts, there, seen)
        self.assertIn("Courier", asked)
        self.assertIn(f"job: {self.run_.name}", asked)  # In its description.
        paper = self.draw("svg", look=Look(style="paper")).decode()
        for colour in re.findall(r"stroke: #(\w\w)(\w\w)(\w\w)", paper):
            self.assertEqual(len(set(colour)), 1, colour)

    def test_axes_that_are_logarithmic_show_powers_without_prefix(self):
        svg = self.draw("svg", "iterations").decode()
        self.assertNotIn("[10", svg.replace("10^", ""))
        self.assertIn(">10", svg)

    def test_inlined_figures_share_no_names_and_need_nothing(self):
        svg = inline(self.draw("svg"), "a")
        self.assertTrue(svg.startswith("<svg"))
        self.assertNotIn("http", svg)
        self.assertNotIn("<title", svg)
        names = set(re.findall(r'\bid="([^"]*)"', svg))
        self.assertTrue(all(name.startswith("a-") for name in names))
        for name in re.findall(r'(?:href="#|url\(#)([^")]*)', svg):
            self.assertIn(name, names)

    def test_format_is_that_of_the_ending(self):
        self.assertEqual([format_of(name) for name in ("a.PDF", "a", "a.eps")],
                         ["pdf", "svg", "eps"])
        with self.assertRaisesRegex(FigureError, "a.jpg"):
            format_of("a.jpg")

    def test_characters_stand_where_the_values_are(self):
        lines = text(preset_figure("velocity", self.run_), 80).splitlines()
        marks = dict(re.findall(r"(B\d) (.)\2{5}", "\n".join(lines)))
        rows = [line[line.index("|") + 1:] for line in lines if "|" in line]
        last = {body: next(i for i, row in enumerate(rows) if mark * 4 in row[-12:])
                for body, mark in marks.items() if body != "B1"}  # Which lies on the axis.
        self.assertEqual(sorted(last, key=last.get), ["B3", "B2"])  # The faster one on top.
        self.assertIn(" o start, × end of a contact cycle", lines)


if __name__ == "__main__":
    unittest.main()
