"""The TypeScript client of client/node: installed, type-checked and run as a user would, against a
real contactd."""

import pathlib
import re
import shutil
import subprocess
import unittest

from contact.v1 import admin_service_pb2, job_service_pb2
from contactd import PATIENCE_S, ServerTest, three_ball_chain

ROOT = pathlib.Path(__file__).parents[2]


class NodeTest(ServerTest):

    def setUp(self):
        if not shutil.which("npm"):
            self.skipTest("npm is not installed")
        super().setUp()
        for part in ("client/node", "proto"):
            shutil.copytree(ROOT / part, self.folder / part, ignore=shutil.ignore_patterns(
                "node_modules", "dist", "generated", *([] if part == "proto" else ["proto"])))
        self.example = self.folder / "client" / "node"
        try:
            install = subprocess.run(
                ["npm", "install", "--no-audit", "--no-fund", "--fetch-retries=0",
                 "--fetch-timeout=20000"],
                cwd=self.example, capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            self.skipTest("npm's registry does not answer")
        if install.returncode != 0 and re.search(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT",
                                                 install.stderr):
            self.skipTest("npm's registry is not reachable")
        self.assertEqual(install.returncode, 0, install.stderr)
        build = self.tool("npm", "run", "build")
        self.assertEqual(build.returncode, 0, build.stdout + build.stderr)

    def tool(self, *command):
        return subprocess.run(command, cwd=self.example, capture_output=True, text=True,
                              timeout=4 * PATIENCE_S)

    def test_example_solves_the_chain_and_reads_its_trajectory(self):
        run = self.tool("node", "dist/run.js", f"127.0.0.1:{self.server.port}")
        self.assertEqual(run.returncode, 0, run.stderr)
        printed = run.stdout
        for line, known in (("B1-B2  COLLISION  mu", 2.259378079e8),
                            ("B2-B3  NIRV  mu", 4.563828953e8), ("B3 ", 0.155004951207)):
            number = float(re.search(rf"^{line} (\S+)", printed, re.MULTILINE)[1])
            self.assertAlmostEqual(number / known, 1, delta=1e-6)
        self.assertIn("1001 samples, largest force B1-B2 104.65", printed)
        self.assertIn("SUCCEEDED  convergence FULL", printed)

    def test_package_works_in_a_folder_that_has_nothing_else(self):
        pack = self.tool("npm", "pack")
        self.assertEqual(pack.returncode, 0, pack.stderr)
        bare = self.folder / "bare"
        bare.mkdir()
        block = (self.example / "README.md").read_text("utf-8").split("$ cat first.mjs\n")[1]
        program, printed = block.split("$ node first.mjs\n")
        (bare / "first.mjs").write_text(
            program.replace("127.0.0.1:7070", f"127.0.0.1:{self.server.port}"))
        (bare / "wrong.mts").write_text("import {Client, type Scenario} from 'contactsim';\n"
                                        "const scenario: Scenario = {titel: 'x'};\n"
                                        "new Client('127.0.0.1:1').submit(scenario);\n")
        install = subprocess.run(
            ["npm", "install", "--no-audit", "--no-fund",
             next(self.example.glob("contactsim-*.tgz")), "typescript@5.9.3"],
            cwd=bare, capture_output=True, text=True, timeout=120)
        self.assertEqual(install.returncode, 0, install.stderr)
        shutil.rmtree(self.folder / "client")  # What it needs is in the package.
        shutil.rmtree(self.folder / "proto")
        run = subprocess.run(["node", "first.mjs"], cwd=bare, capture_output=True, text=True,
                             timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stdout), (0, printed.split("```")[0]), run.stderr)
        check = subprocess.run(["npx", "tsc", "--noEmit", "--strict", "--module", "NodeNext",
                                "--target", "ES2022", "wrong.mts"],
                               cwd=bare, capture_output=True, text=True, timeout=4 * PATIENCE_S)
        self.assertEqual(re.findall(r"^(\S+)\(2,\d+\)", check.stdout, re.MULTILINE),
                         ["wrong.mts"], check.stdout)

    def run_program(self, program):
        """What a program of the package prints."""
        (self.example / "program.mjs").write_text(
            "import {Client, ContactError, values} from './dist/contact.js';\n"
            f"const client = new Client('127.0.0.1:{self.server.port}');\n{program}\nclient.close();\n")
        run = self.tool("node", "program.mjs")
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_every_call_of_the_contract_is_there(self):
        source = (self.example / "contact.ts").read_text("utf-8")
        for module in (job_service_pb2, admin_service_pb2):
            for service in module.DESCRIPTOR.services_by_name.values():
                for method in service.methods:
                    self.assertIn(f".{method.name}(", source)

    def test_every_call_of_the_contract_answers(self):
        name = self.server.run(three_ball_chain(), labels={"study": "chain"}).name
        printed = self.run_program(f"""
        const name = '{name}';
        const {{scenario}} = await client.get(name);
        const found = [];
        for await (const job of client.list({{labels: {{study: 'chain'}}}})) found.push(job.name);
        console.log(found.length, found[0] === name);
        const series = await client.series(name, {{channels: ['B3.velocity'], max_points: 10}});
        console.log(values(series.columns[1]).at(-1).toFixed(6));
        console.log((await client.serverInfo()).version);
        console.log((await client.validate(scenario)).estimate.samples);
        let bytes = 0;
        for await (const part of client.artifact(name, 'cycles.csv')) bytes += part.length;
        console.log(bytes > 100);
        for await (const {{jobs}} of client.watchJobs()) {{ console.log(jobs[0].name === name); break; }}
        const base = {{...scenario, title: 'of a sweep'}};
        const sweep = await client.submitSweep({{base, metrics: ['iterations'],
          axes: [{{field: 'contacts[*].restitution', values: [0.5, 0.7]}}]}}, {{labels: {{kind: 'sweep'}}}});
        let cells = 0;
        for await (const {{sweep_cell}} of client.watch(sweep.name, ['sweep_cell'])) cells += Boolean(sweep_cell);
        console.log(cells, (await client.cancel(sweep.name)).state);
        const noted = await client.update(name, {{note: 'good'}});
        const bare = await client.update(name, {{labels: {{}}}});
        console.log(noted.labels.study, bare.note, Object.keys(bare.labels).length);
        await client.delete(name);
        let copied = 0;
        for await (const part of client.backup()) copied += part.length;
        console.log(copied > 1000);""")
        self.assertRegex(printed, r"^1 true\n0\.15\d+\n\d+\.\d+\.\d+\n\d+\ntrue\ntrue\n2 SUCCEEDED\nchain good 0\ntrue\n$")

    def test_all_that_is_wrong_is_told_with_what_is_expected(self):
        printed = self.run_program("""
        const ball = {name: 'A', mass_kg: -1, radius_m: 0.02};
        const told = async (call) => {
          const error = await call.catch((caught) => caught);
          console.log(error instanceof ContactError, error.reason, error.violations.length);
          console.log(error.message);
        };
        await told(client.submit({titel: 'x', bodies: [{...ball, mass_kg: '1'}], start: 'APRT'}));
        await told(client.submit({bodies: [ball, {...ball, name: 'B'}], end_time_s: 1}));
        await told(client.get('jobs/none'));
        const job = await client.submit({bodies: [{...ball, mass_kg: 1}], end_time_s: 1e-3,
          contacts: []});
        for await (const _ of client.watch(job.name)) {}
        await told(client.series(job.name, {channels: ['A.velocty']}));""")
        self.assertIn("true FIELD_INVALID 3\nthe scenario is invalid\n  titel: unknown field — did you mean "
                      "'title'?\n  bodies[0].mass_kg: expected a number, got '1'\n  start: unknown value 'APRT' "
                      "— did you mean 'APART'?\n", printed)
        self.assertRegex(printed, r"true SCENARIO_INVALID 2\n.*\n  bodies\[0\]\.mass_kg: is -1; must be .*\n"
                                  r"  bodies\[1\]\.mass_kg: is -1; must be ")
        self.assertIn("true JOB_NOT_FOUND 0\n", printed)
        self.assertRegex(printed, r"(?s)true FIELD_INVALID 1\n.*channels\[0\].*did you mean 'A\.velocity'")

    def test_missing_server_is_told_in_one_line(self):
        run = self.tool("node", "dist/run.js", "127.0.0.1:1")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertEqual(run.stderr.splitlines(),
                         ["cannot reach contactd at 127.0.0.1:1; start one with contactctl dev, or "
                          "give its HOST:PORT"])

    def test_wrong_fields_and_kinds_do_not_compile(self):
        (self.example / "wrong.ts").write_text(
            "import {Client} from './contact.js';\n"
            "const client = new Client('127.0.0.1:1');\n"
            "await client.submit({bodies: [{nme: 'A'}]});\n"
            "client.watch('jobs/x', ['cycles']);\n"
            "(await client.get('jobs/x')).convergance;\n")
        check = self.tool("npx", "tsc", "--noEmit")
        self.assertNotEqual(check.returncode, 0)
        places = re.findall(r"^wrong\.ts\((\d+),", check.stdout, re.MULTILINE)
        self.assertEqual(places, ["3", "4", "5"], check.stdout)


if __name__ == "__main__":
    unittest.main()
