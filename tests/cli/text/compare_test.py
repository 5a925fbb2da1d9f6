"""contactctl compare: what differs between runs, and whether it matters."""

import csv
import io
import json
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest


class CompareTest(CliTest):

    def setUp(self):
        super().setUp()
        self.a = self.solve()
        self.b = self.solve("--set", "contacts[0].restitution=0.6")

    def solve(self, *flags):
        return self.run_it("run", CHAIN, *flags, "-o", "name")[0].strip()

    def test_only_parameters_that_differ_are_shown_with_their_path(self):
        text, _ = self.run_it("compare", self.a, self.b, "-o", "json", code=8)
        compared = json.loads(text)
        self.assertEqual(compared["parameters"],
                         [{"path": "contacts[0].restitution", "values": ["0.8", "0.6"]}])
        self.assertFalse(compared["equal"])

    def test_runs_are_drawn_over_each_other_named_by_what_differs(self):
        path = self.folder / "both.csv"
        _, said = self.run_it("compare", self.a, self.b, "--plot", path, "--channels",
                              "B3.velocity", code=8)
        self.assertEqual(said, f"{path}\n")
        rows = list(csv.reader(path.read_text("utf-8").splitlines()))
        self.assertEqual(rows[0], ["curve", "time [s]", "velocity of B3 [m/s]"])
        for name, key in ((self.a, "0.8"), (self.b, "0.6")):
            values = [float(value) for curve, _, value in rows[1:] if curve == key]
            self.assertEqual(len(values), 1001)
            self.assertEqual(values[-1], self.server.get(name).final_bodies[2].velocity_m_per_s)
        svg = self.folder / "both.svg"
        self.run_it("compare", self.a, self.b, self.solve("--set", "end_time_s=3e-3"), "--plot",
                    svg, code=8)
        drawn = svg.read_text("utf-8")
        for words in ("contact force of B1-B2 [N]", "contact force of B2-B3 [N]", "end_time_s = 0.003",
                      self.server.get(self.b).spec_sha256):
            self.assertIn(words, drawn)
        _, said = self.run_it("compare", self.a, self.b, "--plot", svg, "--channels", "B9.x",
                              code=2)
        self.assertIn("B9.x", said)

    def test_same_scenario_gives_equal_results(self):
        text, _ = self.run_it("compare", self.a, self.solve(), "--rel", 0, "--abs", 0)
        self.assertIn("The scenarios are the same.", text)
        self.assertIn("equal within max(0, 0 |baseline|)", text)

    def test_results_are_those_of_the_jobs_with_verdicts(self):
        rows = list(csv.DictReader(io.StringIO(
            self.run_it("compare", self.a, self.b, "-o", "csv", code=8)[0])))
        self.assertEqual(rows[0]["kind"], "parameter")
        named = {row["name"]: row for row in rows}
        a, b = self.server.get(self.a), self.server.get(self.b)
        mu = named["B1-B2 #1 μ"]
        of_a, of_b = (next(c.mu for c in job.cycles if c.contact == "B1-B2") for job in (a, b))
        self.assertEqual((float(mu[self.a]), float(mu[self.b])), (of_a, of_b))
        self.assertEqual(float(mu[f"deviation of {self.b}"]), (of_b - of_a) / of_a)
        self.assertEqual(mu["verdict"], "DIFFERS")
        self.assertEqual(named["B2-B3 #1 ε out"]["verdict"], "ok")
        self.assertEqual(named["B2-B3 #1 ε out"]["unit"], "1")
        self.assertEqual(float(named["B3 final velocity"][self.b]),
                         b.final_bodies[2].velocity_m_per_s)
        self.assertEqual(named["steps"]["verdict"], "")

    def test_tolerance_decides(self):
        near = self.solve("--set", "solver.restitution_tolerance=1e-4")
        self.run_it("compare", self.a, near, "--rel", "1e-12", "--abs", 0, code=8)
        self.run_it("compare", self.a, near, "--rel", "1e-2")
        self.run_it("compare", self.a, self.b, "--abs", "1e12")

    def test_printed_jobs_are_compared_without_a_server(self):
        path = self.folder / "golden.json"
        path.write_text(self.run_it("describe", self.a, "-o", "json")[0])
        self.run_it("compare", path, self.a, "--rel", 0, "--abs", 0)
        self.run_it("compare", path, path, server="127.0.0.1:1")
        path.write_text("{}")
        self.assertIn("holds no job", self.run_it("compare", path, self.a, code=3)[1])

    def test_a_missing_cycle_differs(self):
        short = self.solve("--set", "end_time_s=1e-3")
        text, _ = self.run_it("compare", self.a, short, code=8)
        self.assertRegex(text, r"cycles +2 +\d")

    def test_three_runs_and_latex(self):
        third = self.solve("--set", "contacts[*].damping=HUNT_CROSSLEY")
        text, _ = self.run_it("compare", self.a, self.b, third, "--format", "latex", code=8)
        self.assertEqual(text.count("\\begin{tabular}"), 2)
        self.assertIn("contacts[0].damping & - & - & HUNT\\_CROSSLEY", text)
        table, _ = self.run_it("compare", self.a, self.b, third, code=8)
        self.assertIn("B1-B2 #1 ε out", table)

    def test_wrong_uses_are_told(self):
        self.run_it("compare", self.a, code=2)
        self.run_it("compare", self.a, "nix", code=6)
        for jobs in (self.a, "nofile.csv"), ("nofile.csv", self.a), (self.a, "runs/b.json"):
            said = self.run_it("compare", *jobs, code=11)[1]
            self.assertRegex(said, r"there is no file (nofile\.csv|runs/b\.json)\n")
        _, said = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml")
        self.run_it("compare", self.a, said.split()[0], code=2)


if __name__ == "__main__":
    unittest.main()
