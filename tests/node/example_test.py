"""The Node client of client/node, installed as a user would and run against a real contactd."""

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
            shutil.copytree(ROOT / part, self.folder / part,
                            ignore=shutil.ignore_patterns("node_modules"))
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

    def node(self, *arguments):
        run = subprocess.run(["node", *arguments], cwd=self.example, capture_output=True,
                             text=True, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_example_solves_the_chain_and_reads_its_trajectory(self):
        printed = self.node("run.mjs", f"127.0.0.1:{self.server.port}")
        for line, known in (("B1-B2  COLLISION  mu", 2.259378079e8),
                            ("B2-B3  NIRV  mu", 4.563828953e8), ("B3 ", 0.155004951207)):
            number = float(re.search(rf"^{line} (\S+)", printed, re.MULTILINE)[1])
            self.assertAlmostEqual(number / known, 1, delta=1e-6)
        self.assertIn("1001 samples, largest force B1-B2 104.65", printed)
        self.assertIn("SUCCEEDED  convergence FULL", printed)


if __name__ == "__main__":
    unittest.main()
