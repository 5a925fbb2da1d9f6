"""contactctl where no server is needed."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

CONTACTCTL = os.environ["CONTACTCTL"]
SCENARIOS = pathlib.Path(__file__).parents[3] / "client" / "scenarios"
CHAIN = SCENARIOS / "three-ball-chain.yaml"


class Usage(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactctl-test-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_it(self, *arguments, code, **keywords):
        """Runs contactctl; returns what it printed and what it said."""
        environment = {k: v for k, v in os.environ.items() if k != "CONTACT_SERVER"}
        run = subprocess.run([CONTACTCTL, *map(str, arguments)], cwd=self.folder, timeout=60,
                             env=environment, capture_output=True, encoding="utf-8", **keywords)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def test_without_arguments_it_shows_where_to_start(self):
        printed, said = self.run_it(code=0)
        about, examples = printed.split("\n\n")
        self.assertEqual(len(about.splitlines()), 6)
        self.assertEqual(len(examples.splitlines()), 3)
        self.assertTrue(all(len(line) <= 90 for line in printed.splitlines()))
        self.assertIn("contactctl run three-ball-chain.yaml", printed)
        self.assertEqual(said, "")
        self.assertIn("Exit codes:", self.run_it("--help", code=0)[0])

    def test_help_of_every_command_is_an_answer_and_not_a_failure(self):
        for command in ("run", "submit", "watch", "wait", "list", "describe", "result", "cancel",
                        "delete", "validate", "init", "version", "server"):
            printed, said = self.run_it(command, "--help", code=0)
            self.assertIn("Usage:", printed)
            self.assertEqual(said, "")

    def test_what_a_newcomer_tries_is_answered_with_what_would_work(self):
        self.assertEqual(self.run_it("run", "bouncing-ball", code=11)[1],
                         "contactctl: there is no file bouncing-ball — --template bouncing-ball "
                         "takes the example of this name\n")
        self.assertIn("give two jobs or more, the baseline first",
                      self.run_it("compare", "last", code=2)[1])
        said = self.run_it("run", "-t", "bouncing-ball", "--set", "restitution=0.3", code=3)[1]
        self.assertIn("--set: restitution: unknown field — --var restitution=0.3 gives the variable "
                      "of this name its value\n", said)

    def test_help_is_a_command_too(self):
        self.assertEqual(self.run_it("help", "run", code=0), self.run_it("run", "--help", code=0))
        self.assertEqual(self.run_it("help", "sweep", "export", code=0),
                         self.run_it("sweep", "export", "--help", code=0))
        self.assertIn("did you mean 'plot'?", self.run_it("help", "plto", code=2)[1])
        tutorial = self.run_it("help", "tutorial", code=0)[0]
        for command in re.findall("contactctl ([a-z]+)", tutorial):
            self.run_it("help", command, code=0)

    def test_misspelt_commands_and_flags_have_a_hint(self):
        self.assertEqual(self.run_it("rnu", "x.yaml", code=2)[1],
                         "contactctl: unknown command 'rnu' — did you mean 'run'?\n"
                         "See contactctl --help.\n")
        self.assertEqual(self.run_it("list", "--sever=x:1", code=2)[1],
                         "contactctl: unknown flag '--sever=x:1' — did you mean '--server'?\n"
                         "See contactctl list --help.\n")
        self.assertEqual(self.run_it("server", "inof", code=2)[1],
                         "contactctl: unknown command 'inof' — did you mean 'info'?\n"
                         "See contactctl server --help.\n")
        self.assertIn("— did you mean 'table'?\n", self.run_it("list", "-o", "tabel", code=2)[1])
        self.assertIn("— did you mean 'RUNNING'?\n",
                      self.run_it("list", "--state", "runing", code=2)[1])

    def test_wrong_usage_is_code_2_on_stderr(self):
        for arguments in (["run"], ["list", "extra"], ["list", "--limit", "-1"],
                          ["list", "-o", "xml"], ["list", "-o", "svg"], ["list", "--state", "X"],
                          ["list", "--label", "novalue"], ["list", "--timeout", "soon"],
                          ["list", "--server", "nowhere"], ["watch", "x", "-o", "json"],
                          ["init", "no-such"], ["validate", CHAIN, "--set", "nonsense"],
                          ["watch", "x", "--after-sequence", "minus"], ["server"]):
            with self.subTest(arguments):
                printed, said = self.run_it(*arguments, code=2)
                self.assertEqual(printed, "")
                self.assertTrue(said.startswith("contactctl: "), said)

    def test_no_server_is_told_quickly_with_what_to_do(self):
        start = time.monotonic()
        for command in (["list"], ["describe", "x"], ["watch", "x"], ["wait", "x"],
                        ["cancel", "x"], ["delete", "x"], ["server", "info"], ["run", CHAIN],
                        ["submit", CHAIN]):
            printed, said = self.run_it(*command, "--server", "127.0.0.1:1", code=4)
            self.assertEqual(printed, "")
            self.assertIn("cannot reach contactd at 127.0.0.1:1 (connection refused)", said)
            self.assertIn("contactd --listen 127.0.0.1:1 --data-dir DIR", said)
            self.assertIn("--server HOST:PORT", said)
        self.assertLess(time.monotonic() - start, 30)

    def test_server_can_be_named_by_the_environment(self):
        run = subprocess.run([CONTACTCTL, "list"], env={**os.environ, "CONTACT_SERVER": "[::1]:1"},
                             capture_output=True, encoding="utf-8", timeout=60)
        self.assertEqual(run.returncode, 4)
        self.assertIn("[::1]:1", run.stderr)

    def test_invalid_scenario_is_not_sent(self):
        _, said = self.run_it("run", CHAIN, "--set", "contacts[0].restitution=2", "--server",
                              "127.0.0.1:1", code=3)
        self.assertEqual(said, "--set: contacts[0].restitution: is 2; must be in (0, 1]\n1 error\n")

    def test_shipped_scenarios_are_valid(self):
        for file in SCENARIOS.glob("*.yaml"):
            if file.stem.endswith("-sweep"):
                continue  # What a sweep may hold is another schema.
            printed, said = self.run_it("validate", file, code=0)
            self.assertIn(": valid; ", printed)
            self.assertEqual(said, "")

    def test_reference_and_schemas_beside_the_scenarios_are_fresh(self):
        for file, arguments in (("README.md", ["--markdown"]), ("contact.schema.json", []),
                                ("contact-sweep.schema.json", ["sweep"])):
            made = self.run_it("schema", *arguments, code=0)[0]
            self.assertEqual(made, (SCENARIOS / file).read_text("utf-8"),
                             f"make it again: contactctl schema {' '.join(arguments)} > {file}")

    def test_scenarios_name_the_schema_beside_them(self):
        for file in SCENARIOS.glob("*.yaml"):
            name = file.read_text().splitlines()[0].removeprefix("# yaml-language-server: $schema=")
            self.assertTrue((SCENARIOS / name).is_file(), name)

    def test_standard_input_is_a_file(self):
        printed, _ = self.run_it("validate", "-", code=0, input=CHAIN.read_text())
        self.assertEqual(printed,
                         "-: valid; 3 bodies, 2 contacts, 0 supports, 0 loads, 4 ms\n")

    def test_init_writes_a_scenario_and_does_not_replace_one(self):
        printed, said = self.run_it("init", "two-balls", code=0)
        self.assertEqual(printed, "two-balls.yaml\n")
        self.assertTrue(said.startswith("Next:  contactctl run two-balls.yaml\n"), said)
        written = self.folder / "two-balls.yaml"
        self.assertEqual(written.read_text(), (SCENARIOS / "two-balls.yaml").read_text())
        self.assertIn("contactctl schema > contact.schema.json", said)
        written.write_text("mine")
        self.assertIn("--force", self.run_it("init", "two-balls", code=11)[1])
        self.assertEqual(written.read_text(), "mine")
        self.run_it("init", "two-balls", "--force", code=0)
        self.assertNotEqual(written.read_text(), "mine")

    def test_init_lists_and_prints(self):
        self.assertIn("spring-wall", self.run_it("init", "--list", code=0)[0])
        self.assertEqual(self.run_it("init", "spring-wall", "--file", "-", code=0)[0],
                         (SCENARIOS / "spring-wall.yaml").read_text())

    def test_init_of_a_sweep_writes_its_scenario_too(self):
        printed, said = self.run_it("init", "table-3-sweep", code=0)
        self.assertEqual(printed, "table-3-sweep.yaml\nthree-ball-chain.yaml\n")
        self.assertIn("contactctl sweep run table-3-sweep.yaml\n", said)
        self.assertIn(": valid; 50 cells", self.run_it("validate", "table-3-sweep.yaml", code=0)[0])
        (self.folder / "three-ball-chain.yaml").write_text("mine")
        self.run_it("init", "table-3-sweep", "--force", code=0)
        self.assertEqual((self.folder / "three-ball-chain.yaml").read_text(), "mine")

    def test_models_are_shown_without_a_server(self):
        self.assertIn("α = 3(1−ε)/2", self.run_it("model", "list", code=0)[0])
        laws = json.loads(self.run_it("model", "list", "-o", "json", code=0)[0])
        self.assertEqual(len(laws), 15)
        shown = self.run_it("model", "show", "hunt-crossley", code=0)[0]
        self.assertIn("0.5   0.75    0.6629622   +32.59 %", shown)
        self.assertEqual(json.loads(self.run_it("model", "show", "FLORES", "-o", "json",
                                                code=0)[0])["source"], "Flores et al. 2011")
        compared = self.run_it("model", "compare", "exact", "lee-wang", "--restitution", "0.5",
                               code=0)[0]
        self.assertEqual(compared, "LAW           0.5\n"
                                   "EXACT     0.50000\n"
                                   "LEE_WANG  0.79920\n")
        points = json.loads(self.run_it("model", "compare", "exact", "-o", "json", code=0)[0])
        self.assertEqual({point["method"] for point in points}, {"closed form"})

    def test_wrong_models_are_code_2(self):
        self.assertIn("did you mean 'FLORES'?", self.run_it("model", "show", "flors", code=2)[1])
        self.run_it("model", "compare", "exact", "--restitution", "1.5", code=2)
        self.run_it("model", "show", "exact", "-o", "csv", code=2)

    def test_local_files_that_fail_are_code_11(self):
        self.run_it("validate", "no-such.yaml", code=11)
        self.run_it("validate", self.folder, code=11)
        self.run_it("init", "two-balls", "--file", "no/such/folder/x.yaml", code=11)

    def test_output_that_cannot_be_written_is_code_11(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([CONTACTCTL, "version"], stdout=full, stderr=subprocess.PIPE,
                                 timeout=60)
        self.assertEqual(run.returncode, 11)

    def test_version_is_three_numbers(self):
        self.assertRegex(self.run_it("version", code=0)[0], r"^contactctl \d+\.\d+\.\d+")


if __name__ == "__main__":
    unittest.main()
