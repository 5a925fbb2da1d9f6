"""Scenarios from dicts and files, and what is said of wrong ones."""

import pathlib
import tempfile
import unittest

from contact.v1 import scenario_pb2
from contactsim import InvalidScenario, load_scenario, templates

SCENARIOS = pathlib.Path(__file__).parents[2] / "client" / "scenarios"


class LoadTest(unittest.TestCase):

    def load_text(self, text):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            return load_scenario(file.name)

    def assertInvalid(self, source, *lines):
        with self.assertRaises(InvalidScenario) as caught:
            load_scenario(source)
        self.assertEqual([str(v) for v in caught.exception.violations], list(lines))

    def test_every_shipped_scenario_is_read(self):
        for path in set(SCENARIOS.glob("*.yaml")) - set(SCENARIOS.glob("*-sweep.yaml")):
            with self.subTest(path.name):
                scenario = load_scenario(path)
                self.assertGreater(scenario.end_time_s, 0)
                self.assertTrue(scenario.contacts[0].stiffness > 1e4 or
                                scenario.bodies[0].HasField("material"))

    def test_numbers_need_no_point_and_names_may_look_like_truths(self):
        scenario = self.load_text(
            "bodies: [{name: on, mass_kg: 1e3, fixed: true}]\nsolver: {max_steps: 1e9}\n"
            "end_time_s: .inf\n")
        self.assertEqual(scenario.bodies[0].name, "on")
        self.assertEqual(scenario.bodies[0].mass_kg, 1000)
        self.assertTrue(scenario.bodies[0].fixed)
        self.assertEqual(scenario.solver.max_steps, 10**9)
        self.assertEqual(scenario.end_time_s, float("inf"))

    def test_variables_stand_for_their_values(self):
        text = ("variables: {e: 0.8, name: ball, side: left}\ntitle: ε is ${e}, $${e}\n"
                "bodies: [{name: '${name}', mass_kg: 1}]\n"
                "contacts:\n  - {between: ['${name}'], wall: {side: '${side}'}, restitution: '${e}'}\n")
        with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            scenario, other = load_scenario(file.name), load_scenario(file.name, {"e": 0.5})
            with self.assertRaisesRegex(ValueError, "unknown variable 'ee'; did you mean 'e'"):
                load_scenario(file.name, {"ee": 0.5})
        self.assertEqual(scenario.title, "ε is 0.8, ${e}")
        self.assertEqual(scenario.bodies[0].name, "ball")
        self.assertEqual(scenario.contacts[0].between, ["ball"])
        self.assertEqual(scenario.contacts[0].wall.side, scenario_pb2.Wall.LEFT)
        self.assertEqual(scenario.contacts[0].restitution, 0.8)
        self.assertEqual(other.contacts[0].restitution, 0.5)
        self.assertEqual(load_scenario({"title": "${e}"}).title, "${e}")  # Nothing is declared.

    def test_undefined_variable_is_told_at_its_place(self):
        self.assertInvalid({"variables": {"e": 0.8}, "contacts": [{"restitution": "${f}"}]},
                           "contacts[0].restitution: undefined variable 'f' — there are e")
        self.assertInvalid({"contacts": [{"restitution": "${f}"}]},
                           "contacts[0].restitution: expected a number, got '${f}'")

    def test_json_file_and_dict_and_message_are_one(self):
        text = '{"bodies": [{"name": "A", "mass_kg": 2}], "loads": [{"gravity": {}}]}'
        message = scenario_pb2.Scenario(
            bodies=[scenario_pb2.Body(name="A", mass_kg=2)],
            loads=[scenario_pb2.Load(gravity=scenario_pb2.Load.Gravity())])
        source = {"bodies": [{"name": "A", "mass_kg": 2}], "loads": [{"gravity": {}}]}
        self.assertEqual(self.load_text(text), message)
        self.assertEqual(load_scenario(source), message)
        self.assertIs(load_scenario(message), message)

    def test_enum_is_read_in_any_case(self):
        scenario = load_scenario({"contacts": [{"damping": "hunt-crossley"}]})
        self.assertEqual(scenario.contacts[0].damping, scenario_pb2.Contact.HUNT_CROSSLEY)

    def test_all_mistakes_are_told_at_once_with_path_and_hint(self):
        with self.assertRaises(InvalidScenario) as caught:
            load_scenario({
                "bodies": [{"name": 7, "mas_kg": 1}],
                "contacts": [{"restitution": "0,8", "damping": "FLORS"}],
                "supports": {},
                "loads": [{"constant": {}, "sine": {}}],
                "solver": {"max_iterations": 1.5},
                "output": {"ledger_only": 1},
                "end_time_s": True,
            })
        violations = {v.field: v for v in caught.exception.violations}
        self.assertEqual(list(violations), [
            "bodies[0].name", "bodies[0].mas_kg", "contacts[0].restitution",
            "contacts[0].damping", "supports", "loads[0].sine", "solver.max_iterations",
            "output.ledger_only", "end_time_s"])
        self.assertEqual(violations["bodies[0].mas_kg"].hint, "did you mean 'mass_kg'?")
        self.assertIn("did you mean FLORES?", violations["contacts[0].damping"].hint)
        self.assertIn("contacts[0].restitution: expected a number, got '0,8'",
                      str(caught.exception))

    def test_fields_are_set_by_index_name_or_all(self):
        chain = load_scenario("three-ball-chain", set={
            "contacts[B2-B3].restitution": 0.6, "contacts[0].damping": "hunt-crossley",
            "bodies[*].mass_kg": "2", "bodies[B1].velocity_m_per_s": 1, "end_time_s": 1e-3,
            "output.ledger_only": True, "solver.restitution_tolerance": None,
            "loads": [{"body": "B1", "constant": {"force_n": 5}}]})
        self.assertEqual([c.restitution for c in chain.contacts], [0.8, 0.6])
        self.assertEqual(chain.contacts[0].damping, scenario_pb2.Contact.HUNT_CROSSLEY)
        self.assertEqual([b.mass_kg for b in chain.bodies], [2, 2, 2])
        self.assertEqual(chain.bodies[0].velocity_m_per_s, 1)
        self.assertEqual(chain.end_time_s, 1e-3)
        self.assertTrue(chain.output.ledger_only)
        self.assertFalse(chain.solver.HasField("restitution_tolerance"))
        self.assertEqual(chain.loads[0].constant.force_n, 5)

    def test_message_that_is_given_is_not_changed(self):
        message = load_scenario("two-balls")
        changed = load_scenario(message, set={"end_time_s": 1})
        self.assertEqual(changed.end_time_s, 1)
        self.assertEqual(message.end_time_s, 4e-3)

    def test_wrong_paths_are_told_together(self):
        with self.assertRaises(InvalidScenario) as caught:
            load_scenario("newton-cradle", set={
                "contacts[B1-B2].restitution": 1, "contacts[B1-B9].restitution": 1,
                "contacts[3].restitution": 1, "contacts.restitution": 1, "contacts[0]": 1,
                "bodies[B8].mass_kg": 1, "supports[x].damping_n_s_per_m": 1, "end_time_s.x": 1,
                "bodies[0].mas_kg": 1, "a..b": 1, "end_time_s": "long"})
        self.assertEqual([str(v) for v in caught.exception.violations], [
            "contacts: 'B1-B2' has its fields in common with the other contacts of contacts[0] — "
            "contacts[0] sets them for all",
            "contacts: there is no contact 'B1-B9' — did you mean 'B1-B2'?",
            "contacts[3]: there are only 1",
            "contacts: is a list — contacts[0], or contacts[*] for every entry",
            "contacts: cannot be set entry by entry — set a field of it, or the whole list",
            "bodies: there is no body 'B8' — there are B1, B2, B3, B4, B5",
            "supports: its entries have no names — give an index, or [*]",
            "end_time_s: has no field 'x'",
            "bodies[0].mas_kg: unknown field — did you mean 'mass_kg'?",
            "a..b: is no path — such as contacts[0].restitution",
            "end_time_s: expected a number, got 'long'"])

    def test_templates_are_the_shipped_scenarios(self):
        shipped = {path.stem for path in SCENARIOS.glob("*.yaml")}
        self.assertEqual(set(templates()), {s for s in shipped if not s.endswith("-sweep")})
        for name in templates():
            self.assertEqual(load_scenario(name), load_scenario(SCENARIOS / f"{name}.yaml"))
        with self.assertRaisesRegex(FileNotFoundError, "did you mean 'two-balls'?"):
            load_scenario("two-bals")
        with self.assertRaisesRegex(FileNotFoundError, "there are bouncing-ball, "):
            load_scenario("elephant")

    def test_document_that_is_no_mapping_is_refused(self):
        self.assertInvalid({"bodies": "A"}, "bodies: expected a list, got 'A'")
        with self.assertRaises(InvalidScenario):
            self.load_text("just a word")


if __name__ == "__main__":
    unittest.main()
