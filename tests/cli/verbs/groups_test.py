"""Groups of cycles on the command line: two balls and a wall, where one μ a cycle is not enough."""

import csv
import io
import json
import unittest

from cli_case import SCENARIOS, CliTest

WALL = SCENARIOS / "two-balls-wall.yaml"
CYCLE = ("--set", "solver.restitution_scope=CYCLE")


class GroupsTest(CliTest):

    def test_cycles_that_share_a_factor_are_solved_and_shown(self):
        printed, said = self.run_it("run", WALL)
        self.assertIn("convergence FULL", printed)
        self.assertRegex(printed, r"(?m)^CONTACT +GROUP +CYCLES +END +STATUS")
        row = next(line for line in printed.splitlines() if " to " in line and "wall" in line)
        self.assertRegex(row, r"^wall +\d+  \d+ to \d+  \w+ +CONVERGED  \w+ +2\.7\d+e\+08  0\.678")
        self.assertRegex(said, r"(?m)^\w+ cycles? \d+.* and the next share one μ: ")
        self.assertNotIn("Try:", said)

    def test_every_form_of_the_result_has_the_groups(self):
        job = json.loads(self.run_it("run", WALL, "-o", "json")[0])
        self.assertEqual(job["convergence"], "FULL")
        wall, = [g for g in job["groups"] if g["contact"] == "wall" and g["cycles"] == 2]
        self.assertAlmostEqual(wall["mu"] / 2.76e8, 1, delta=0.01)
        mine = [c for c in job["cycles"] if (c["contact"], c["group"]) == ("wall", wall["number"])]
        self.assertEqual([c["number"] for c in mine],
                         [wall["first_cycle"], wall["first_cycle"] + 1])
        self.assertEqual({c["status"] for c in mine}, {wall["status"]})
        printed = self.run_it("export", job["name"], "-o", "csv", "--table", "groups")[0]
        rows = list(csv.DictReader(io.StringIO(printed)))
        self.assertEqual([float(row["mu [N·s/m^(n+1)]"]) for row in rows],
                         [g["mu"] for g in job["groups"]])
        events = [json.loads(line)
                  for line in self.run_it("watch", job["name"], "-o", "jsonl")[0].splitlines()]
        told = [e["group"] for e in events if "group" in e]
        zeros = [{field: value for field, value in g.items() if not value} for g in job["groups"]]
        self.assertEqual([{**zero, **g} for zero, g in zip(zeros, told)], job["groups"])
        self.assertTrue(any("group_growth" in e for e in events))

    def test_watch_tells_of_growths_and_groups(self):
        name = self.run_it("run", WALL, "-o", "name")[0].strip()
        printed = self.run_it("watch", name)[0]
        self.assertIn("and the next share one μ: ", printed)
        self.assertRegex(printed, r"(?m)^wall group \d+, cycle \d+ to \d+: CONVERGED, μ 27\d+")

    def test_a_factor_for_each_cycle_is_7_and_tells_what_to_do(self):
        printed, said = self.run_it("run", WALL, *CYCLE, code=7)
        self.assertIn("INFEASIBLE", printed)
        self.assertIn("convergence PARTIAL", printed)
        self.assertRegex(printed, r"(?m)^wall group \d+: no μ gives a restitution of 0\.678: ")
        self.assertIn("Try:   --set solver.restitution_scope=AUTO", said)
        advice = self.run_it("validate", WALL, *CYCLE)
        self.assertIn("solver.restitution_scope: is CYCLE", "".join(advice))

    def test_an_encounter_as_one_group_is_solved_too(self):
        job = json.loads(self.run_it("run", WALL, "-o", "json", "--set",
                                     "solver.restitution_scope=ENCOUNTER")[0])
        self.assertEqual(job["convergence"], "FULL")
        self.assertTrue(all(g["end"] != "NON_SEPARATION" for g in job["groups"]))

    def test_metrics_of_sweeps_read_groups(self):
        sweep = self.run_it("sweep", "run", WALL, "--grid",
                            "bodies[0].velocity_m_per_s=1.535:1.536:2", "--metric",
                            "groups[wall].mu", "-o", "name")[0]
        printed = self.run_it("sweep", "export", sweep.strip(), "-o", "csv")[0]
        first = next(csv.DictReader(io.StringIO(printed)))
        job = json.loads(self.run_it("run", WALL, "-o", "json")[0])
        wall = next(g for g in job["groups"] if g["contact"] == "wall")
        metric, = [value for name, value in first.items() if name.startswith("groups[")]
        self.assertEqual(float(metric), wall["mu"])

    def test_comparison_tells_which_groups_differ(self):
        jobs = [self.run_it("run", WALL, *scope, "-o", "name", code=None)[0].strip()
                for scope in ((), CYCLE)]
        self.assertRegex(self.run_it("compare", *jobs, code=8)[0],
                         r"(?m)^wall group \d+ cycles +\d+ to \d+ +-")


if __name__ == "__main__":
    unittest.main()
