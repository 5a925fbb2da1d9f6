"""contactctl verify: the numbers of a job at finer steps and tolerances."""

import json
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest

BALLS = SCENARIOS / "two-balls.yaml"


class VerifyTest(CliTest):

    def job(self, path, *assignments, code=0):
        flags = [word for assignment in assignments for word in ("--set", assignment)]
        return self.run_it("run", path, *flags, "-o", "name", code=code)[0].strip()

    def verify(self, job, *flags, code=0):
        return json.loads(self.run_it("verify", job, "-o", "json", *flags, code=code)[0])

    def orders(self, path, *assignments, code=0):
        job = self.job(path, "solver.method=RK4", *assignments, code=code)
        document = self.verify(job, "--rel", "1e-3")
        self.assertEqual(document["differences"] == [], code == 0, document["differences"])
        orders = [number["order"] for number in document["numbers"]]
        return document["order"], [order for order in orders if order is not None]

    def test_order_of_rk4_is_4_in_a_linear_contact(self):
        promised, observed = self.orders(BALLS, "contacts[0].exponent=1", "contacts[0].stiffness=1e6",
                                         "solver.step_s=2e-5", code=7)  # Its proof misses by 4e-6.
        self.assertEqual(promised, 4)
        self.assertGreaterEqual(len(observed), 2)  # A peak between steps may go to and fro.
        for order in observed:
            self.assertAlmostEqual(order, 4, delta=0.5)

    def test_order_of_rk4_is_that_of_the_first_touch_in_a_hertz_contact(self):
        promised, observed = self.orders(CHAIN, "solver.step_s=1.6e-5")
        self.assertEqual(promised, 2.5)
        self.assertGreaterEqual(sum(abs(order - 2.5) < 0.5 for order in observed), 5)

    def test_job_of_default_tolerance_holds_and_leaves_nothing_behind(self):
        job = self.job(CHAIN)
        printed = self.run_it("verify", job)[0]
        self.assertRegex(printed, r"TOLERANCE +CYCLES")
        self.assertIn("verified: all within 1e-08", printed)
        self.assertEqual(self.run_it("list", "-o", "name")[0].strip(), job)

    def test_job_of_coarse_tolerance_or_step_is_told_to_be_far_off(self):
        job = self.job(CHAIN, "solver.relative_tolerance=1e-5", code=7)  # The proof denies its rows.
        document = self.verify(job, code=8)
        self.assertFalse(document["holds"])
        self.assertEqual([run["value"] for run in document["runs"]], [1e-6, 1e-7, 1e-8])
        job = self.job(BALLS, "solver.method=RK4", "solver.step_s=1e-5", code=7)
        self.assertIn("FAR", self.run_it("verify", job, code=8)[0])

    def test_runs_that_are_kept_are_named_and_whole(self):
        document = self.verify(self.job(BALLS), "--keep")
        last = document["runs"][-1]["job"]
        self.assertIn("final velocity", self.run_it("compare", document["job"]["job"], last,
                                                    "--rel", "1e-7")[0])
        self.assertIn("verifies", self.run_it("describe", last, "-o", "json")[0])

    def test_time_limit_ends_the_runs_too(self):
        job = self.job(BALLS, "solver.method=RK4", "solver.step_s=1e-8")
        self.run_it("verify", job, "--timeout", "300ms", code=5)
        left = self.run_it("list", "-o", "json")[0]
        states = {one["name"]: one["state"] for one in json.loads(left)["jobs"]}
        del states[job]
        # The coarsest may have ended in time; the newest, which is the finest, has not.
        self.assertIn(next(iter(states.values())), ("CANCELLED", "RUNNING"), states)


if __name__ == "__main__":
    unittest.main()
