"""contactctl paper: the paper's numbers, made again by a real contactd."""

import csv
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from contactd import PATIENCE_S, ServerTest

CONTACTCTL = os.environ["CONTACTCTL"]


FIGURES = "fig3 fig4 fig5 fig9 fig10 fig11 fig12 fig14 fig15 fig16 fig17".split()


class Paper(ServerTest):

    def make(self, *items, code=0):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        run = subprocess.run([CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", "paper",
                              *items, "-o", directory.name], capture_output=True, encoding="utf-8",
                             timeout=PATIENCE_S)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return pathlib.Path(directory.name), run

    def test_every_figure_and_table_is_made_and_every_number_holds(self):
        made, _ = self.make()
        for name in ("fig3 fig4 fig5 fig9 fig10 fig11 fig12 fig14 fig15 fig16 fig17 table3 "
                     "exponent").split():
            rows = list(csv.reader((made / f"{name}.csv").read_text("utf-8").splitlines()))
            self.assertGreater(len(rows), 15, name)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, name)
        page = (made / "index.html").read_text("utf-8")
        for name in FIGURES:
            self.assertIn("</svg>", (made / f"{name}.svg").read_text("utf-8"), name)
            self.assertIn(f'<h2 id="{name}">', page)
        self.assertEqual(page.count("<svg"), len(FIGURES) + 1)
        self.assertNotIn("http", page)  # Nothing comes from elsewhere.
        self.assertNotIn("<script", page)
        for name in "table2 table3 table4 fig4 fig15 exponent".split():
            self.assertTrue((made / f"{name}.txt").is_file(), name)
            item = json.loads((made / f"{name}.json").read_text("utf-8"))
            self.assertTrue(item["holds"], item)

    def test_page_says_which_items_have_nothing_printed_to_compare(self):
        made, _ = self.make("fig3", "table2", "table3")
        page = (made / "index.html").read_text("utf-8")
        self.assertEqual(re.findall(r"<tr><td>(\w+)</td><td>[^<]*</td><td>(\w+)</td></tr>", page),
                         [("fig3", "shown"), ("table2", "holds"), ("table3", "shown")])

    def test_table_3_says_that_nothing_was_published_to_compare_it_with(self):
        made, run = self.make("table3")
        note = "no map of them was published: there is nothing to compare these numbers with."
        self.assertIn("table3: The cells of the printed Table 3", run.stdout)
        for text in (run.stdout, (made / "table3.txt").read_text("utf-8"),
                     (made / "index.html").read_text("utf-8"),
                     json.loads((made / "table3.json").read_text("utf-8"))["note"]):
            self.assertIn(note, text)

    def test_table_3_is_a_map_with_its_numbers_folded_below(self):
        made, _ = self.make("table3")
        page = (made / "index.html").read_text("utf-8")
        rows = list(csv.DictReader((made / "table3.csv").read_text("utf-8").splitlines()))
        told = [row["passes_published_process"] for row in rows]
        drawn = re.findall(r"<text[^>]*>(\d+)</text>", page[page.index("<svg"):page.index("</svg>")])
        for passes in set(told) - {"nan"}:
            self.assertGreaterEqual(drawn.count(passes), told.count(passes), passes)
        self.assertIn("<details><summary>50 numbers</summary>", page)
        self.assertEqual((made / "table3.svg").read_text("utf-8").count("<svg"), 1)

    def test_table_2_and_4_are_those_of_the_paper(self):
        made, _ = self.make("table2", "table4")
        self.assertEqual(sorted(path.name for path in made.iterdir()),
                         ["index.html", "table2.json", "table2.txt", "table4.json", "table4.txt"])
        numbers = json.loads((made / "table2.json").read_text("utf-8"))["numbers"]
        published = [0.8453, 0.8661, 0.8020, 0.8306, 0.8067, 0.7059, 6]
        self.assertEqual([n["published"] for n in numbers], published)
        for n in numbers:
            self.assertLessEqual(abs(n["process"] - n["published"]), 7e-4)
        self.assertAlmostEqual(numbers[4]["converged"], 0.8, delta=1e-8)
        row = json.loads((made / "table4.json").read_text("utf-8"))["numbers"][:11]
        self.assertEqual([n["process"] for n in row], [0, 0, 1, 1, 5, 1, 1, 1, 1, 1, 0])

    def test_every_cell_of_table_3_converges_alike_at_every_velocity(self):
        made, _ = self.make("table3")
        cells = {}
        for row in csv.DictReader((made / "table3.csv").read_text("utf-8").splitlines()):
            passes = float(row["passes_converged"])
            self.assertFalse(math.isnan(passes))
            self.assertLessEqual(passes - 1, 6)
            cells.setdefault(row["restitution"], set()).add(passes)
        self.assertEqual(len(cells), 10)
        self.assertEqual({len(passes) for passes in cells.values()}, {1})

    def test_figures_carry_the_marks_of_the_paper(self):
        made, _ = self.make("fig10", "fig15")
        for name, labels in (("fig10", 2), ("fig15", 11)):
            svg = (made / f"{name}.svg").read_text("utf-8")
            self.assertEqual(svg.count("μ/k = "), labels, name)
        for words in ("contact force", "equivalent external force", "start of a cycle",
                      "end of a cycle"):
            self.assertIn(words, svg)

    def test_figures_are_drawn_in_the_format_asked_for(self):
        made, _ = self.make("fig9", "--format", "png")
        self.assertTrue((made / "fig9.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("<svg", (made / "index.html").read_text("utf-8"))

    def test_an_unknown_item_is_named(self):
        _, run = self.make("fig99", code=2)
        self.assertIn("unknown item 'fig99'", run.stderr)

    def test_leaves_no_jobs_behind(self):
        self.make("table2")
        listed = subprocess.run([CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", "list",
                                 "-o", "name"], capture_output=True, encoding="utf-8", timeout=60)
        self.assertEqual(listed.stdout, "")


if __name__ == "__main__":
    unittest.main()
