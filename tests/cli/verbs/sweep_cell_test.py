"""contactctl sweep cell: one cell of a sweep whole, and as a job of its own."""

import json
import unittest

from cli_case import CHAIN, CliTest

VELOCITY, RESTITUTION = "bodies[0].velocity_m_per_s", "contacts[*].restitution"


class SweepCellTest(CliTest):

    def setUp(self):
        super().setUp()
        self.sweep = self.run_it(
            "sweep", "run", CHAIN, "--grid", f"{VELOCITY}=0.1:0.5:3", "--grid",
            f"{RESTITUTION}=0.7,0.8,1.5", "--metric", "cycles[B1-B2].mu", "-o",
            "name")[0].strip()

    def cell(self, which, *flags, code=0):
        return self.run_it("sweep", "cell", self.sweep, which, *flags, code=code)

    def test_cell_is_told_whole(self):
        printed, said = self.cell(4)
        self.assertIn(f"{self.sweep} cell 4  SUCCEEDED  convergence FULL\n", printed)
        self.assertRegex(printed, r"bodies\[0\].velocity_m_per_s +0\.3\n")
        self.assertRegex(printed, r"contacts\[\*\].restitution +0\.8\n")
        self.assertRegex(printed, r"cycles\[B1-B2\].mu +\d+")
        self.assertIn(f"contactctl sweep cell {self.sweep.split('/')[1]} 4 --run", said)
        cell = json.loads(self.cell(0, "-o", "json")[0])
        self.assertEqual((cell["index"], cell["values"]), (0, [0.1, 0.7]))

    def test_cell_is_found_by_its_values(self):
        for which in (f"{VELOCITY}=0.3,{RESTITUTION}=0.8", "restitution=0.8,velocity_m_per_s=0.3",
                      "velocity_m_per_s=0.3000001,restitution=8e-1"):
            self.assertEqual(self.cell(which)[0], self.cell(4)[0])

    def test_cell_that_failed_says_why(self):
        printed, _ = self.cell(5)
        self.assertIn("cell 5  FAILED\n", printed)
        self.assertIn("SCENARIO_INVALID: ", printed)
        self.assertIn("is 1.5; must be in (0, 1]", printed.replace("\n", " "))

    def test_cell_is_run_alone_to_the_same_numbers(self):
        metric = json.loads(self.cell(4, "-o", "json")[0])["metrics"][0]
        name = self.cell("velocity_m_per_s=0.3,restitution=0.8", "--run", "-o", "name")[0].strip()
        job = self.server.get(name)
        self.assertEqual(next(c.mu for c in job.cycles if c.contact == "B1-B2"), metric)
        self.assertEqual(job.scenario.bodies[0].velocity_m_per_s, 0.3)
        self.assertEqual(dict(job.labels), {"sweep": self.sweep.split("/")[1], "cell": "4"})
        figure = self.folder / "force.svg"
        self.run_it("plot", name, "force", "-f", figure)
        self.assertIn("</svg>", figure.read_text("utf-8"))

    def test_cell_that_breaks_a_rule_cannot_be_run(self):
        self.assertIn("must be in (0, 1]", self.cell(5, "--run", code=3)[1])

    def test_what_is_no_cell_is_told(self):
        self.assertIn("there is no cell 9; the last is 8", self.cell(9, code=2)[1])
        self.assertIn("the nearest value is 0.8", self.cell("restitution=0.85", code=2)[1])
        self.assertIn("3 cells have restitution=0.8", self.cell("restitution=0.8", code=2)[1])
        self.assertIn("did you mean 'restitution'?", self.cell("restituton=0.8", code=2)[1])
        self.assertIn("expected the number of a cell", self.cell("x", code=2)[1])
        run = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.assertIn("is no sweep", self.run_it("sweep", "cell", run, 0, code=2)[1])


if __name__ == "__main__":
    unittest.main()
