"""Figures in characters and for LaTeX: the same figures in other forms."""

import fcntl
import os
import pty
import re
import shutil
import struct
import subprocess
import termios
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest
from contactd import PATIENCE_S
from plot_test import PRESETS

DOCUMENT = r"""\documentclass{article}\usepackage[utf8]{inputenc}\usepackage{gnuplot-lua-tikz}
\begin{document}\input{a}\end{document}"""
NASTY = r"it's \input{pwned} 100% {a}_b ^~#&$ μ |x|<y>"


class PlotFormsTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.run_it("run", CHAIN, "-o", "name")[0].strip()

    def tex(self, preset="force", name=None):
        path = self.folder / "a.tex"
        self.run_it("plot", name or self.name, preset, "-f", path)
        return path.read_text("utf-8")

    def on_terminal(self, width):
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        with os.fdopen(slave, "wb") as terminal:
            process = subprocess.Popen(self.command("plot", self.name, "force", "-o", "txt"),
                                       stdout=terminal, env={**os.environ, "TERM": "xterm"})
        seen = b""
        while True:
            try:
                block = os.read(master, 65536)
            except OSError:  # Nobody writes any more.
                break
            if not block:
                break
            seen += block
        self.assertEqual(process.wait(PATIENCE_S), 0)
        return seen.decode().splitlines()

    def test_every_preset_is_printed_in_eighty_characters(self):
        for preset in PRESETS:
            with self.subTest(preset):
                printed, said = self.run_it("plot", self.name, preset, "-o", "txt")
                self.assertEqual(said, "")
                lines = printed.splitlines()
                self.assertEqual(lines[0].strip(), "Triple-ball chain")
                self.assertLessEqual(max(map(len, lines)), 80)
                self.assertRegex(printed, r"\+-* \S.* -+\+")  # What y is.
                self.assertTrue(lines[-1].startswith(self.name + " ("), lines[-1])
                self.assertEqual(self.run_it("plot", self.name, preset, "-o", "txt")[0], printed)

    def test_curves_stand_where_their_values_are(self):
        lines = self.run_it("plot", self.name, "velocity", "-o", "txt")[0].splitlines()
        key = next(line for line in lines if "B1 **" in line)
        marks = dict(re.findall(r"(B\d) (.)\2{5}", key))
        rows = [line[line.index("|") + 1:] for line in lines if "|" in line]
        last = {body: next(i for i, row in enumerate(rows) if mark * 4 in row[-12:])
                for body, mark in marks.items() if body != "B1"}  # Which lies on the axis.
        self.assertEqual(sorted(last, key=last.get), ["B3", "B2"])  # The faster one on top.
        self.assertIn("\n o start, × end of a contact cycle\n", "\n".join(lines))

    def test_figure_in_characters_is_as_wide_as_the_terminal(self):
        for width in (60, 120):
            border = next(line for line in self.on_terminal(width) if "+---" in line)
            self.assertIn(len(border), range(width - 8, width + 1))

    def test_figure_in_characters_goes_to_a_file_that_is_named(self):
        path = self.folder / "a.txt"
        self.assertEqual(self.run_it("plot", self.name, "force", "-f", path)[0], f"{path}\n")
        self.assertEqual(path.read_text("utf-8"),
                         self.run_it("plot", self.name, "force", "-o", "txt")[0])
        both = self.folder / "both.txt"
        self.run_it("compare", self.name, self.name, "--plot", both)
        self.assertIn("B1-B2.contact_force [N]", both.read_text("utf-8"))

    def test_tikz_tells_its_source_and_is_the_same_each_time(self):
        for preset in PRESETS:
            text = self.tex(preset)
            self.assertTrue(text.startswith("% title: Triple-ball chain\n"))
            self.assertIn(f"% job: {self.name}\n", text)
            self.assertEqual(self.tex(preset), text)
            self.assertNotRegex(text, r"\d\d:\d\d:\d\d")

    def test_default_name_of_tikz_ends_as_latex_wants_it(self):
        run = subprocess.run(self.command("plot", self.name, "force", "-o", "tikz"),
                             cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stdout), (0, "force.tex\n"), run.stderr)
        self.assertTrue((self.folder / "force.tex").exists())

    def test_words_of_a_user_cannot_become_commands_of_tex(self):
        name = self.run_it("run", CHAIN, "--set", f"title={NASTY}", "-o", "name")[0].strip()
        text = "".join(line for line in self.tex(name=name).splitlines(True)
                       if not line.startswith("%"))
        self.assertNotIn(r"\input", text)
        self.assertIn(r"it's \textbackslash{}input\{pwned\} 100\% \{a\}\_b", text)

    @unittest.skipUnless(shutil.which("pdflatex"), "pdflatex is not installed")
    def test_latex_sets_every_preset(self):
        (self.folder / "document.tex").write_text(DOCUMENT)
        name = self.run_it("run", CHAIN, "--set", f"title={NASTY}", "-o", "name")[0].strip()
        for preset in PRESETS:
            self.tex(preset, name)
            run = subprocess.run(
                ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "document.tex"],
                cwd=self.folder, capture_output=True, encoding="latin-1", timeout=PATIENCE_S,
                env={**os.environ, "TEXINPUTS": ".:/usr/share/texmf/tex//:"})
            self.assertEqual(run.returncode, 0, run.stdout[-2000:])

    def test_heat_map_is_drawn_for_latex_and_not_in_characters(self):
        sweep = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml", "-o", "name")[0]
        path = self.folder / "map.tex"
        self.run_it("sweep", "export", sweep.strip(), "--heatmap", path)
        self.assertIn(r"\begin{tikzpicture}", path.read_text("utf-8"))
        self.run_it("sweep", "export", sweep.strip(), "--heatmap", self.folder / "map.txt", code=2)


if __name__ == "__main__":
    unittest.main()
