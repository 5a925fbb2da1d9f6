"""A keyword that a function does not have comes with what to write instead."""

import asyncio
import unittest

import contactsim
from contactsim.keywords import hinted
from sample_run import sample_run


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


class ValuesTest(unittest.TestCase):
    """What stands where something else is expected comes with what that is."""

    def setUp(self):
        self.client = contactsim.Client("127.0.0.1:1")  # Nobody is asked.
        self.addCleanup(self.client.close)

    def assertTold(self, error, words, call, *arguments, **keywords):
        with self.assertRaises(error) as caught:
            call(*arguments, **keywords)
        self.assertIn(words, str(caught.exception))

    def test_other_type_is_told_with_the_one_expected(self):
        submit = self.client.submit
        self.assertTold(TypeError, "a scenario is a file, the name of a template, a dict or a "
                        "contact.v1.Scenario, and not int 1", submit, 1)
        self.assertTold(TypeError, "set is a dict such as", submit, "two-balls", set=["a"])
        self.assertTold(TypeError, "variables is a dict such as", submit, "two-balls", variables=1)
        self.assertTold(TypeError, "write {'run': '1'}", submit, "two-balls", labels={"run": 1})
        self.assertTold(TypeError, "as in {'end_time_s': [0.5, 0.7]}, and not int 1",
                        self.client.sweep, "two-balls", {"end_time_s": 1})
        self.assertTold(TypeError, "a Result or a row of list(), and not by list []",
                        self.client.get, [])

    def test_other_word_is_told_with_those_that_are_near(self):
        run = sample_run()
        self.assertTold(KeyError, "there is no channel 'B.velocty'; did you mean 'B.velocity'",
                        run.__getitem__, "B.velocty")
        self.assertTold(KeyError, "there are time, A.position", run.__getitem__, "xyz")
        self.assertTold(ValueError, "no preset 'hysterisis'; did you mean 'hysteresis'?",
                        run.plot, "hysterisis")
        self.assertTold(ValueError, "no preset 'xyz'; there are position, displacement", run.plot, "xyz")
        self.assertTold(ValueError, "no kind of event 'cycles'; did you mean 'cycle'",
                        self.client.watch, "last", kinds=["cycles"])
        self.assertTold(ValueError, "did you mean 'SUCCEEDED'?", self.client.jobs, states=["succeded"])


if __name__ == "__main__":
    unittest.main()
