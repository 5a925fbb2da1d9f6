"""Variables of scenario and sweep files, and --var."""

import json
import pathlib
import tempfile
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest

BALL = SCENARIOS / "bouncing-ball.yaml"


class VariablesTest(CliTest):

    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.files = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.files / name
        path.write_text(text, "utf-8")
        return path

    def job(self, *arguments):
        return json.loads(self.run_it(*arguments, "-o", "json")[0])

    def test_run_takes_other_values_of_file_and_template(self):
        short = ("--set", "end_time_s=0.1")
        self.assertEqual(
            self.job("submit", BALL, *short)["scenario"]["contacts"][0]["restitution"], 0.8)
        for source in ((BALL,), ("-t", "bouncing-ball")):
            scenario = self.job("run", *source, *short, "--var", "restitution=0.6", "--var",
                                "height_m=0.5")["scenario"]
            self.assertEqual(scenario["contacts"][0]["restitution"], 0.6)
            self.assertEqual(scenario["bodies"][0]["position_m"], 0.5)

    def test_set_comes_after_var(self):
        scenario = self.job("submit", BALL, "--var", "restitution=0.6", "--set",
                            "contacts[0].restitution=0.7")["scenario"]
        self.assertEqual(scenario["contacts"][0]["restitution"], 0.7)

    def test_validate_tells_mistakes_where_the_variable_stands(self):
        self.run_it("validate", BALL, "--var", "restitution=1")
        said = self.run_it("validate", BALL, "--var", "restitution=2", code=3)[1]
        self.assertRegex(said, r"bouncing-ball.yaml:\d+:\d+: contacts\[0\].restitution: is 2; must")
        file = self.write("bad.yaml", "variables: {speed: 1}\nend_time_s: ${sped}\n")
        said = self.run_it("validate", file, code=3)[1]
        self.assertIn(f"{file}:2:13: undefined variable 'sped' — did you mean 'speed'?\n", said)

    def test_unknown_name_is_a_mistake_of_the_command_line(self):
        for command in ("run", "submit", "validate"):
            self.assertIn("unknown variable 'restituton' — did you mean 'restitution'?",
                          self.run_it(command, BALL, "--var", "restituton=1", code=2)[1])
        self.assertIn("the file has none", self.run_it("run", CHAIN, "--var", "e=1", code=2)[1])
        self.run_it("run", BALL, "--var", "restitution", code=2)

    def test_sweep_file_and_its_base_have_variables_of_their_own(self):
        base = self.write("base.yaml", CHAIN.read_text("utf-8").replace(
            "bodies:", "variables: {v: 0.2}\nbodies:").replace(
            "velocity_m_per_s: 0.2", 'velocity_m_per_s: "${v}"'))
        sweep = self.write("sweep.yaml", "variables: {file: base.yaml, high: 0.9}\nbase: ${file}\n"
                           "axes: [{field: 'contacts[*].restitution', values: [0.5, '${high}']}]\n"
                           "metrics: ['final_bodies[B3].velocity_m_per_s']\n")
        self.run_it("validate", sweep)
        cells = self.job("sweep", "run", sweep, "--var", "high=0.8", "--var", "v=0.3")
        self.assertEqual(cells["job"]["sweep"]["axes"][0]["values"], [0.5, 0.8])
        self.assertEqual(cells["job"]["sweep"]["base"]["bodies"][0]["velocity_m_per_s"], 0.3)
        grid = self.job("sweep", "run", base, "--grid", "contacts[0].restitution=0.5,0.6", "--var",
                        "v=0.4")
        self.assertEqual(grid["job"]["sweep"]["base"]["bodies"][0]["velocity_m_per_s"], 0.4)
        self.assertIn("unknown variable 'x' — there are v",
                      self.run_it("sweep", "run", sweep, "--var", "x=1", code=2)[1])
        sweep.write_text(sweep.read_text().replace("${high}", "${hihg}"))
        self.assertIn(f"{sweep}:3:", self.run_it("sweep", "run", sweep, code=3)[1])

    def test_repeated_job_is_not_read_as_a_template(self):
        name = self.run_it("submit", CHAIN, "--set", "title=${x} $${y}", "-o", "name")[0].strip()
        again = self.job("submit", "--like", name)
        self.assertEqual(again["scenario"]["title"], "${x} $${y}")


if __name__ == "__main__":
    unittest.main()
