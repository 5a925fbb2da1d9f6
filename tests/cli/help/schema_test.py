"""The JSON Schemas of `contactctl schema` as ajv, the validator of editors, reads them."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from contactd import PATIENCE_S, ServerTest

CONTACTCTL = os.environ["CONTACTCTL"]
SCENARIOS = pathlib.Path(__file__).parents[3] / "client" / "scenarios"
CHAIN = (SCENARIOS / "three-ball-chain.yaml").read_text()
SWEEP = (SCENARIOS / "table-3-sweep.yaml").read_text()

# Reads schema and documents from files; prints for each document what is wrong with it.
VALIDATOR = """
const [schema, ...files] = process.argv.slice(2);
const read = (file) => require('fs').readFileSync(file, 'utf8');
const ajv = new (require('ajv'))({allErrors: true, strict: true, strictTypes: false, strictRequired: false});
ajv.addKeyword('enumDescriptions');
require('ajv-formats')(ajv);
const validate = ajv.compile(JSON.parse(read(schema)));
const told = files.map((file) => validate(require('yaml').parse(read(file))) ? [] : validate.errors);
console.log(JSON.stringify(told));
"""


class Ajv:
    """ajv in a folder of its own, once for all tests."""

    folder = None

    @classmethod
    def install(cls, case):
        if cls.folder:
            return
        if not shutil.which("npm"):
            case.skipTest("npm is not installed")
        folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-ajv-"))
        unittest.addModuleCleanup(shutil.rmtree, folder)
        try:
            install = subprocess.run(
                ["npm", "install", "--no-audit", "--no-fund", "--fetch-retries=0",
                 "--fetch-timeout=20000", "ajv@8.20.0", "ajv-formats@3.0.1", "yaml@2.8.1"],
                cwd=folder, capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            case.skipTest("npm's registry does not answer")
        if install.returncode != 0 and re.search(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT",
                                                 install.stderr):
            case.skipTest("npm's registry is not reachable")
        case.assertEqual(install.returncode, 0, install.stderr)
        (folder / "validate.js").write_text(VALIDATOR)
        cls.folder = folder


class SchemaTest(ServerTest):

    def setUp(self):
        Ajv.install(self)
        super().setUp()

    def mistakes(self, kind, *texts):
        """What ajv finds in each text, a list of errors."""
        schema = subprocess.run([CONTACTCTL, "schema", kind], capture_output=True, check=True,
                                timeout=PATIENCE_S).stdout
        (self.folder / "schema.json").write_bytes(schema)
        names = []
        for number, text in enumerate(texts):
            names.append(str(self.folder / f"{number}.yaml"))
            pathlib.Path(names[-1]).write_text(text)
        run = subprocess.run(
            ["node", "validate.js", str(self.folder / "schema.json"), *names], cwd=Ajv.folder,
            capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def test_every_shipped_file_is_valid(self):
        for file in SCENARIOS.glob("*.yaml"):
            kind = "sweep" if file.stem.endswith("-sweep") else "scenario"
            self.assertEqual(self.mistakes(kind, file.read_text()), [[]], file.name)

    def test_variables_may_stand_for_any_value(self):
        good = CHAIN.replace("title:", "variables: {e: 0.8, u: NEWTON, n: B1}\ntitle:").replace(
            "restitution: 0.8", 'restitution: "${e}"').replace(
            "solver: {", 'solver: {update: "${u}", max_iterations: "${e}", ').replace(
            "between: [B1, B2]", 'between: ["${n}", B2]')
        bad = [good.replace("e: 0.8", "e: [1]"), good.replace("e: 0.8", "a b: 1"),
               CHAIN.replace("restitution: 0.8", 'restitution: "$e"')]
        told, *wrong = self.mistakes("scenario", good, *bad)
        self.assertEqual(told, [])
        self.assertTrue(all(wrong), wrong)
        sweep = SWEEP.replace("base:", "variables: {low: 0.1}\nbase:").replace(
            "low: 0.1, high", 'low: "${low}", high')
        self.assertEqual(self.mistakes("sweep", sweep), [[]])

    def test_sweep_may_hold_its_base(self):
        base = json.dumps({"bodies": [{"name": "A", "mass_kg": 1}], "end_time_s": 1})
        good = SWEEP.replace("three-ball-chain.yaml", base)
        bad = good.replace("mass_kg", "mas_kg")
        told = self.mistakes("sweep", good, bad)
        self.assertEqual(told[0], [])
        self.assertNotEqual(told[1], [])

    def test_mistakes_are_refused_at_their_place(self):
        for old, new, place in (
                ("restitution: 0.8", "restituton: 0.8", "/contacts/0"),
                ("restitution: 0.8", "restitution: 1.5", "/contacts/0/restitution"),
                ("mass_kg: 0.5", "mass_kg: heavy", "/bodies/0/mass_kg"),
                ("mass_kg: 0.5", "mass_kg: 0", "/bodies/0/mass_kg"),
                ("end_time_s: 4.0e-3", "end_time_s: 0", "/end_time_s"),
                ("end_time_s: 4.0e-3", "", ""),
                ("solver: {", "solver: {update: NEWTON, ", "/solver/update"),
                ("solver: {", "solver: {max_iterations: 1.5, ", "/solver/max_iterations"),
                ("solver: {", "loads: [{constant: {force_n: 1}, step: {}}]\nsolver: {", "/loads/0"),
                ("solver: {", "loads: [{body: B1}]\nsolver: {", "/loads/0")):
            with self.subTest(new):
                self.assertIn(old, CHAIN)
                told, = self.mistakes("scenario", CHAIN.replace(old, new, 1))
                self.assertIn(place, [error["instancePath"] for error in told])

    def test_printed_jobs_are_valid(self):
        def printed(*arguments):
            run = subprocess.run(
                [CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", *map(str, arguments),
                 "-o", "json"], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertIn(run.returncode, (0, 7), run.stderr)
            return run.stdout
        jobs = [printed("run", file) for file in SCENARIOS.glob("*.yaml")
                if not file.stem.endswith("-sweep")]
        cut = printed("run", SCENARIOS / "three-ball-chain.yaml", "--set", "end_time_s=5e-4")
        self.assertIn('"NaN"', cut)  # A cycle that the run cut short.
        jobs += [cut, printed("sweep", "run", SCENARIOS / "table-3-sweep.yaml")]
        sweep = json.loads(jobs[-1])
        jobs[-1] = json.dumps(sweep.get("job", sweep))
        for job, told in zip(jobs, self.mistakes("job", *jobs)):
            self.assertEqual(told, [], job[:200])


if __name__ == "__main__":
    unittest.main()
