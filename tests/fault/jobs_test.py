"""Jobs that go wrong: each costs itself only, and ends in time with its reason."""

import time
import unittest

from contact.v1 import scenario_pb2
from contactd import endless, seconds, spring_wall, three_ball_chain
from fault import *

ATTEMPTS = 3


def explosive():
    """A spring far too stiff for its step: no number is left after a few of them."""
    scenario = spring_wall(1000)
    scenario.supports[0].stiffness_n_per_m = 1e30
    scenario.solver.method = scenario_pb2.Solver.RK4
    scenario.solver.step_s = 1
    return scenario


class BlowUpTest(FaultTest):
    """F8."""

    flags = ("--workers=4",)

    def test_a_run_that_blows_up_fails_alone(self):
        neighbours = [spring_wall(0.4), spring_wall(0.5), three_ball_chain()]
        golden = self.golden(*neighbours)
        for i, scenario in enumerate(neighbours):
            submit(self.server, self.history, scenario, f"neighbour-{i}")
        name = submit(self.server, self.history, explosive(), "explosive").name
        follow(self.server, self.history.watch(name))
        job = self.server.get(name)
        self.assertEqual((job.state, job.state_reason), (Job.FAILED, "NUMERIC"))
        self.assertIn("t = ", job.error.message)
        self.assertPromises(self.server, golden=golden, max_attempts=1)


class PoisonTest(FaultTest):
    """F9."""

    flags = ("--workers=2", f"--max-attempts={ATTEMPTS}")

    def test_a_job_that_takes_the_server_along_is_set_aside(self):
        chain = three_ball_chain()
        golden = self.golden(chain)
        poison = submit(self.server, self.history, endless(), "poison").name
        for _ in range(ATTEMPTS):
            for i in range(20 // ATTEMPTS + 1):
                request = f"{len(self.history.calls)}-{i}"
                submit(self.server, self.history, chain, request)
            wait_for(lambda: self.server.get(poison).state == Job.RUNNING)
            self.server.kill()
            self.server.start()
        final = self.assertPromises(self.server, golden=golden, max_attempts=ATTEMPTS)
        job = self.server.get(poison)
        self.assertEqual((job.state, job.state_reason), (Job.FAILED, "CRASHED"))
        self.assertEqual(job.attempt, ATTEMPTS)
        others = [final[name].state for name in final if name != poison]
        self.assertEqual(others, [Job.SUCCEEDED] * len(others))
        self.figures |= dict(attempts=job.attempt, others=len(others))


class BudgetTest(FaultTest):
    """F10."""

    flags = ("--workers=2",)

    def test_a_spent_budget_ends_the_run_and_keeps_its_record(self):
        late = {}
        for reason, budget in {
                "BUDGET_WALL_TIME": dict(wall_time=seconds(0.5)),
                "BUDGET_STEPS": dict(steps=2000),
                "BUDGET_OUTPUT": dict(output_bytes=100_000)}.items():
            name = submit(self.server, self.history, endless(), reason, budget=budget).name
            follow(self.server, self.history.watch(name))
            job = self.server.get(name)
            self.assertEqual((job.state, job.state_reason), (Job.FAILED, reason))
            self.assertTrue(job.cycles)
            late[reason] = (job.end_time.ToDatetime() - job.start_time.ToDatetime()).total_seconds()
            if reason == "BUDGET_STEPS":
                self.assertLess(job.summary.steps, 2 * 2000)
        self.assertPromises(self.server, max_attempts=1)
        self.assertKept("past_wall_time", late["BUDGET_WALL_TIME"] - 0.5, 1)

    def test_a_cancelled_run_ends_at_once(self):
        waits = []
        for i in range(20):
            name = submit(self.server, self.history, endless(), f"{i}").name
            wait_for(lambda name=name: self.server.get(name).cycles)
            start = time.monotonic()
            self.server.cancel(name)
            follow(self.server, self.history.watch(name, kinds=["state_changed"]))
            waits.append(time.monotonic() - start)
        self.assertPromises(self.server, max_attempts=1)
        self.assertKept("cancelled_after", max(waits), 0.5)


if __name__ == "__main__":
    unittest.main()
