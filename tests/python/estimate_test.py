"""What a server foretells of a scenario, beside what its run then takes."""

import pathlib
import unittest

from contact.v1 import scenario_pb2
from contactd import ServerTest, three_ball_chain
from contactsim import Client, load_scenario

SCENARIOS = pathlib.Path(__file__).parents[2] / "client" / "scenarios"
FACTOR = 3
COUPLED = "three-ball-chain", "newton-cradle"  # A body touches two others: the search is open.
PATIENCE_S = 120


def shipped():
    return [path for path in sorted(SCENARIOS.glob("*.yaml")) if not path.stem.endswith("-sweep")]


class EstimateTest(ServerTest):

    def setUp(self):
        super().setUp()
        self.client = Client(f"127.0.0.1:{self.server.port}")
        self.addCleanup(self.client.close)

    def assert_near(self, estimated, real, what):
        self.assertLessEqual(estimated, FACTOR * real, what)
        self.assertGreaterEqual(estimated, real / FACTOR, what)

    def check(self, scenario, name):
        with self.subTest(name):
            checked = self.client.validate(scenario)
            self.assertEqual(checked.name, "")
            self.assertEqual(list(checked.warnings), [])
            estimate = checked.estimate
            result = self.client.run(scenario, timeout_s=PATIENCE_S)
            # The paper's ball goes 7 mm deep with a radius of 50 mm; nothing else is remarkable.
            deep = [w for w in result.job.warnings if "a tenth of the radius" in w]
            self.assertEqual(list(result.job.warnings), deep)
            self.assertEqual(len(deep), name.startswith("spring-wall"))
            output = sum(event.ByteSize() for event in self.client.watch(result.job))
            if name in COUPLED:
                self.assertEqual((estimate.steps, estimate.HasField("wall_time")), (0, False))
            else:
                self.assert_near(estimate.steps, result.job.summary.steps, "steps")
                self.assertGreater(estimate.wall_time.ToMicroseconds(), 0)
            self.assertEqual(estimate.samples, len(result.series))
            self.assert_near(estimate.output_bytes, output, "bytes")
            self.assertGreater(estimate.memory_bytes, 0)
            self.assertFalse(result.job.HasField("estimate"))

    def test_shipped_scenarios_take_what_is_estimated_within_a_factor_of_three(self):
        self.assertGreaterEqual(len(shipped()), 8)
        for path in shipped():
            if path.stem != "two-balls-wall":  # The growth of its group takes most of the steps.
                self.check(load_scenario(path), path.stem)

    def test_fixed_steps_are_estimated_too(self):
        for stem in ("three-ball-chain", "newton-cradle", "gear-teeth", "spring-wall",
                     "half-sine-pulse"):
            scenario = load_scenario(SCENARIOS / f"{stem}.yaml")
            scenario.solver.method = scenario_pb2.Solver.RK4
            self.check(scenario, stem)

    def test_nothing_is_recorded_where_the_ledger_is_enough(self):
        scenario = load_scenario(SCENARIOS / "bouncing-ball.yaml")
        scenario.output.Clear()
        scenario.output.ledger_only = True
        estimate = self.client.validate(scenario).estimate
        self.assertEqual(estimate.samples, 0)
        self.assertLess(estimate.output_bytes, 10_000)

    def test_an_estimate_of_a_huge_run_takes_no_time(self):
        scenario = load_scenario(SCENARIOS / "bouncing-ball.yaml")
        scenario.contacts[0].restitution = 1 - 1e-12
        scenario.end_time_s = 1e6
        scenario.output.Clear()
        scenario.output.ledger_only = True
        scenario.solver.max_steps = 10**12
        self.assertGreater(self.client.validate(scenario).estimate.steps, 1e7)

    def test_advice_stands_in_the_answer_and_in_the_finished_job(self):
        scenario = three_ball_chain()
        scenario.solver.method = scenario_pb2.Solver.RK4
        scenario.solver.step_s = 1e-4
        told = list(self.client.validate(scenario).warnings)
        self.assertEqual(len(told), 1)
        self.assertIn("solver.step_s: gives a contact of B1-B2 16.1 steps", told[0])
        self.assertEqual(list(self.client.run(scenario).job.warnings), told)

    def test_a_law_that_misses_is_told_once_by_the_run_that_saw_it(self):
        scenario = three_ball_chain()
        for contact in scenario.contacts:
            contact.damping = contact.HUNT_CROSSLEY
            contact.restitution = 0.2
        told = self.client.validate(scenario).warnings
        self.assertIn("contacts[0].restitution: is 0.2; with HUNT_CROSSLEY", told[0])
        warnings = self.client.run(scenario).job.warnings
        self.assertEqual([w for w in warnings if w.startswith("contacts[")], [])
        self.assertTrue(any("its law delivers a restitution of" in w for w in warnings))


if __name__ == "__main__":
    unittest.main()
