"""Axes by name, over variables and of words, and metrics of several cycles, through the server."""

import csv
import io
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest

BALL = SCENARIOS / "bouncing-ball.yaml"


class SweepAxesTest(CliTest):

    def cells(self, file, *grids, metrics="iterations"):
        flags = [flag for grid in grids for flag in ("--grid", grid)]
        text, _ = self.run_it("sweep", "run", file, *flags, "--metric", metrics, "-o", "csv",
                              code=None)  # Some bounces may not converge.
        return list(csv.DictReader(io.StringIO(text)))

    def test_axis_by_name_has_the_cells_of_the_axis_by_index(self):
        metric = "cycles[B1-B2].mu"
        named = self.cells(CHAIN, "contacts[B1-B2].restitution=0.5,0.7", metrics=metric)
        numbered = self.cells(CHAIN, "contacts[0].restitution=0.5,0.7", metrics=metric)
        self.assertEqual([cell["contacts[B1-B2].restitution"] for cell in named], ["0.5", "0.7"])
        self.assertEqual([cell[metric] for cell in named], [cell[metric] for cell in numbered])
        said = self.run_it("sweep", "run", CHAIN, "--grid", "contacts[B1-B4].restitution=0.5",
                           code=3)[1]
        self.assertIn("there is no contact 'B1-B4' — did you mean 'B1-B2'?", said)

    def test_override_by_name_is_that_of_the_entry(self):
        names = [self.run_it("run", CHAIN, "--set", f"contacts[{entry}].restitution=0.6", "-o",
                             "name")[0].strip() for entry in ("B2-B3", 1)]
        first, second = (self.server.get(name) for name in names)
        self.assertEqual(first.scenario, second.scenario)
        self.assertEqual(first.scenario.contacts[1].restitution, 0.6)

    def test_axis_over_a_variable_has_its_name_and_sets_its_field(self):
        metric = "cycles.max.restitution_in"
        cells = self.cells(BALL, "var:restitution=0.6,0.7", "var:height_m=0.5,1", metrics=metric)
        self.assertEqual([(c["var:restitution"], c["var:height_m"], c[metric]) for c in cells],
                         [("0.6", "0.5", "0.6"), ("0.6", "1", "0.6"),
                          ("0.7", "0.5", "0.7"), ("0.7", "1", "0.7")])
        said = self.run_it("sweep", "run", BALL, "--grid", "var:height=1,2", code=2)[1]
        self.assertIn("unknown variable 'height' — did you mean 'height_m'?", said)

    def test_words_are_shown_in_table_map_and_cell(self):
        grids = ("contacts[*].damping=EXACT,FLORES", "bodies[B1].velocity_m_per_s=0.1,0.2")
        self.assertEqual([cell["contacts[*].damping"] for cell in self.cells(CHAIN, *grids)],
                         ["EXACT", "EXACT", "FLORES", "FLORES"])
        flags = [flag for grid in grids for flag in ("--grid", grid)]
        name = self.run_it("sweep", "run", CHAIN, *flags, "-o", "name")[0].strip()
        self.assertRegex(self.run_it("sweep", "watch", name)[0], r"\n +2 +FLORES +0\.1 ")
        self.assertRegex(self.run_it("sweep", "heatmap", name)[0], r"\nFLORES  ")
        cell, _ = self.run_it("sweep", "cell", name, "damping=flores,velocity_m_per_s=0.2")
        self.assertIn(f"{name} cell 3 ", cell)
        self.assertRegex(cell, r"contacts\[\*\]\.damping +FLORES\n")

    def test_metrics_are_of_the_cycles_that_the_run_has(self):
        name = self.run_it("run", BALL, "-o", "name")[0].strip()
        cycles = self.server.get(name).cycles
        expected = {"cycles.count": len(cycles), "cycles[floor].last.delta_max_m":
                    cycles[-1].delta_max_m, "cycles.max.peak_force_n":
                    max(cycle.peak_force_n for cycle in cycles)}
        for metric, value in expected.items():
            cell, = self.cells(BALL, "bodies[ball].position_m=1", metrics=metric)
            self.assertEqual(float(cell[metric]), value, metric)


if __name__ == "__main__":
    unittest.main()
