"""The TypeScript client of client/node: installed, type-checked and run as a user would, against a
real contactd."""

import pathlib
import re
import shutil
import subprocess
import unittest

from contactd import PATIENCE_S, ServerTest

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
