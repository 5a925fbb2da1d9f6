"""A keyword that a function does not have comes with what to write instead."""

import asyncio
import unittest

from contactsim.keywords import hinted


@hinted
def solve(scenario, *, set=None, timeout_s=None):
    return scenario, set, timeout_s


@hinted
async def solve_later(scenario, *, timeout_s=None):
    return scenario, timeout_s


class KeywordsTest(unittest.TestCase):

    def assertHint(self, hint, **keywords):
        with self.assertRaises(TypeError) as caught:
            solve("x", **keywords)
        self.assertEqual(str(caught.exception), f"solve() has no keyword {hint}")

    def test_known_ones_do_as_before(self):
        self.assertEqual(solve("x", set={"a": 1}, timeout_s=2), ("x", {"a": 1}, 2))
        self.assertEqual(asyncio.run(solve_later("x", timeout_s=2)), ("x", 2))
        self.assertEqual(solve.__name__, "solve")

    def test_near_one_is_suggested(self):
        self.assertHint("'timeout'; did you mean 'timeout_s'?", timeout=1)

    def test_field_of_the_scenario_is_set_by_its_path(self):
        self.assertHint("'restitution'; fields of the scenario are set so: "
                        "set={'contacts[*].restitution': 0.7}", restitution=0.7)
        self.assertHint("'end_time'; fields of the scenario are set so: set={'end_time_s': 1}",
                        end_time=1)
        self.assertHint("'max_steps'; fields of the scenario are set so: "
                        "set={'solver.max_steps': 9}", max_steps=9)

    def test_other_one_comes_with_those_there_are(self):
        self.assertHint("'colour'; there are scenario, set, timeout_s", colour="red")
        with self.assertRaisesRegex(TypeError, "there are scenario, timeout_s"):
            solve_later("x", restitution=1)


if __name__ == "__main__":
    unittest.main()
