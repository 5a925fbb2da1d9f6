"""-o yaml says what -o json says."""

import json
import pathlib
import re
import tempfile
import textwrap
import unittest

import yaml

from cli_case import CHAIN, SPRING, CliTest

TABLE3 = CHAIN.parent / "table-3-sweep.yaml"
NASTY = '- NaN: "1e5" #no ${x} \\ it\'s ε - true'


class YamlOutputTest(CliTest):

    def same(self, *arguments, code=0):
        """The document, which is the same in both forms."""
        said = json.loads(self.run_it(*arguments, "-o", "json", code=code)[0])
        text = self.run_it(*arguments, "-o", "yaml", code=code)[0]
        self.assertEqual(yaml.safe_load(text), said, text)
        self.assertEqual(list(yaml.safe_load(text)), list(said))
        return text

    def test_commands_that_print_json_print_the_same_as_yaml(self):
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        other = self.run_it("run", "--like", job, "--set", "contacts[0].restitution=0.6", "-o",
                            "name")[0].strip()
        cut = self.run_it("run", CHAIN, "--set", "end_time_s=5e-4", "-o", "name", code=None)[0]
        sweep = self.run_it("sweep", "run", TABLE3, "-o", "name")[0].strip()
        self.assertIn('"NaN"', self.same("describe", cut.strip()))  # A text in JSON too.
        for arguments in (("describe", job), ("result", job), ("list",), ("server", "status"),
                          ("series", job, "--points", "50"), ("sweep", "export", sweep),
                          ("sweep", "watch", sweep), ("sweep", "cell", sweep, "5"),
                          ("describe", sweep), ("model", "list"),
                          ("model", "show", "flores"), ("schema",), ("schema", "sweep"),
                          ("schema", "job"), ("cancel", job)):
            with self.subTest(arguments):
                self.same(*arguments)
        self.same("compare", job, other, code=8)
        self.assertEqual(self.run_it("compare", job, other, "--format", "yaml", code=8),
                         self.run_it("compare", job, other, "-o", "yaml", code=8))

    def test_settings_and_findings_are_yaml_too(self):
        view = yaml.safe_load(self.run_it("config", "view", "-o", "yaml")[0])
        self.assertEqual(view["output"], {"value": "yaml", "origin": "--output"})
        findings = yaml.safe_load(self.run_it("doctor", "-o", "yaml", code=None)[0])
        self.assertIn("server", [finding["check"] for finding in findings])

    def test_run_submit_and_wait_print_the_job(self):
        for command in (("run", CHAIN), ("submit", CHAIN)):
            job = yaml.safe_load(self.run_it(*command, "-o", "yaml")[0])
            self.assertEqual(job["scenario"]["title"], "Triple-ball chain")
            self.run_it("wait", job["name"], "-o", "yaml")

    def test_scenario_out_of_a_job_is_a_scenario_file(self):
        for file in (CHAIN, SPRING, CHAIN.parent / "glass-balls.yaml"):
            name = self.run_it("submit", file, "--set", f"title={json.dumps(NASTY)}", "--set",
                               "solver.max_steps=1e9", "-o", "name")[0].strip()
            text = self.run_it("describe", name, "-o", "yaml")[0]
            part = re.search(r"^scenario:\n((?:  .*\n)+)", text, re.MULTILINE).group(1)
            with tempfile.TemporaryDirectory() as folder:
                taken = pathlib.Path(folder) / "taken.yaml"
                taken.write_text(textwrap.dedent(part), "utf-8")
                self.run_it("validate", taken)
                again = json.loads(self.run_it("submit", taken, "-o", "json")[0])
            self.assertEqual(again["scenario"], yaml.safe_load(text)["scenario"])
            self.assertEqual(again["scenario"]["title"], NASTY)

    def test_commands_without_json_say_what_they_print(self):
        self.assertIn("--output yaml: this command prints table, jsonl",
                      self.run_it("watch", "x", "-o", "yaml", code=2)[1])
        self.assertIn("--output csv: this command prints table, json, yaml, name",
                      self.run_it("describe", "x", "-o", "csv", code=2)[1])


if __name__ == "__main__":
    unittest.main()
